// SPDX-License-Identifier: MIT OR Apache-2.0
//! Set operations, sharp and smooth, and repetition. Each shares what it is made from.

use super::arrays::{elements, numbers, slice};
use super::blend::emb_blend;
use super::error::emb_status;
use super::geometry::{construct, emb_geom};
use super::handle::{lend, null};
use crate::error::{Result, try_with_capacity};
use crate::geometry::Geometry;
use crate::math::{Aabb, Vec3};

/// The bodies of a composite; `name` is the argument's.
///
/// # Safety
/// `bodies` is NULL or holds `count` handles.
unsafe fn bodies(name: &str, count: usize, bodies: *const *const emb_geom) -> Result<Vec<Geometry>> {
    // SAFETY: the caller's promise.
    let handles = unsafe { slice(name, bodies, elements::<*const emb_geom>("count", count, 1)?) }?;
    if let Some(k) = handles.iter().position(|handle| handle.is_null()) {
        return Err(null(&format!("{name}[{k}]")));
    }
    let mut geometries = try_with_capacity(name, count)?;
    for handle in handles {
        // SAFETY: the caller's promise.
        geometries.push(unsafe { lend(name, *handle) }?.clone());
    }
    Ok(geometries)
}

/// The three integers of an argument.
///
/// # Safety
/// `data` is NULL or holds three integers.
unsafe fn integers(name: &str, data: *const i32) -> Result<[i32; 3]> {
    // SAFETY: the caller's promise.
    let given = unsafe { slice(name, data, 3) }?;
    Ok([given[0], given[1], given[2]])
}

/// The points in any of `count` parts: the least of their values. Of none: +INFINITY everywhere, no body. Exact where
/// every part is and no two are found to have a point in common (their boxes do not meet, or one keeps clear of the
/// other's); else a lower bound of the distance. Over four parts and more a hierarchy over the parts' own bounds is
/// built, which a value searches for the few parts that may be the least; parts without bounds are always asked. The
/// bits are those of asking every part, and of equal values the first part's labels win. The parts live on in it and
/// may be freed. A part that is EMB_SIGN_ONLY makes all of it so. In C declare the array as const emb_geom *parts[n].
/// Errors: EMB_ERROR_NULL_ARGUMENT (naming the part), EMB_ERROR_INVALID_ARGUMENT, EMB_ERROR_MEMORY.
/// Cost: n log n in the parts, then about log n a value.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_union(
    count: usize,
    parts: *const *const emb_geom,
    out_geom: *mut *mut emb_geom,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    unsafe { construct(out_geom, || Geometry::union(&bodies("parts", count, parts)?)) }
}

/// The points in every one of `count` parts: the greatest of their values. Of none: -INFINITY everywhere, all of
/// space. Otherwise as emb_geom_union of the complements: the hierarchy is over parts that leave out a bounded piece of
/// space, such as complements of bodies.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_intersection(
    count: usize,
    parts: *const *const emb_geom,
    out_geom: *mut *mut emb_geom,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    unsafe { construct(out_geom, || Geometry::intersection(&bodies("parts", count, parts)?)) }
}

/// The points of `from` that are not in `remove`: the greater of from's value and of minus remove's. On the faces that
/// the cut leaves, part and tag are remove's.
/// Errors: EMB_ERROR_NULL_ARGUMENT.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_difference(
    from: *const emb_geom,
    remove: *const emb_geom,
    out_geom: *mut *mut emb_geom,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    unsafe { construct(out_geom, || lend("from", from)?.difference(lend("remove", remove)?)) }
}

/// The rest of space: 0 - value. A wall becomes the room in it. Errors: EMB_ERROR_NULL_ARGUMENT.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_complement(g: *const emb_geom, out_geom: *mut *mut emb_geom) -> emb_status {
    // SAFETY: pointers as the header asks.
    unsafe { construct(out_geom, || lend("g", g)?.complement()) }
}

/// The points of `from` that are in none of `count` bodies: as emb_geom_difference of their union, over which a
/// hierarchy is built; of none: from. Errors: EMB_ERROR_NULL_ARGUMENT (naming the body), EMB_ERROR_INVALID_ARGUMENT,
/// EMB_ERROR_MEMORY. Cost: n log n in the bodies.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_difference_of_many(
    from: *const emb_geom,
    count: usize,
    remove: *const *const emb_geom,
    out_geom: *mut *mut emb_geom,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    unsafe { construct(out_geom, || lend("from", from)?.difference_of_many(&bodies("remove", count, remove)?)) }
}

/// The union of `count` parts with its inner edges filled: values that are close are blended as `blend` says. Three
/// and more are blended in rising order, blend(blend(a, b), c) with a <= b <= c, until the next is further behind the
/// result than the blend's support: every part within the support takes part, the value goes on continuously where
/// two parts change places, and the order in which they are given makes no difference to the bit. A lower bound of the
/// distance where the parts' values are 1-Lipschitz and the blend is. Labels are those of the part of least value,
/// closest points NaN where values are blended. Errors:
/// EMB_ERROR_NULL_ARGUMENT (naming the part), EMB_ERROR_INVALID_ARGUMENT, EMB_ERROR_MEMORY. Cost: n log n in the
/// parts; a value asks those within the blend's support.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_smooth_union(
    count: usize,
    parts: *const *const emb_geom,
    blend: *const emb_blend,
    out_geom: *mut *mut emb_geom,
) -> emb_status {
    let build = || {
        // SAFETY: pointers as the header asks.
        let parts = unsafe { bodies("parts", count, parts) }?;
        // SAFETY: as above.
        unsafe { emb_blend::lend(blend, |blend| Geometry::smooth_union(&parts, blend)) }
    };
    // SAFETY: pointers as the header asks.
    unsafe { construct(out_geom, build) }
}

/// The intersection of `count` parts with its edges rounded: the complement of the smooth union of their
/// complements, so that the blend gets values of the opposite sign. Otherwise as emb_geom_smooth_union.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_smooth_intersection(
    count: usize,
    parts: *const *const emb_geom,
    blend: *const emb_blend,
    out_geom: *mut *mut emb_geom,
) -> emb_status {
    let build = || {
        // SAFETY: pointers as the header asks.
        let parts = unsafe { bodies("parts", count, parts) }?;
        // SAFETY: as above.
        unsafe { emb_blend::lend(blend, |blend| Geometry::smooth_intersection(&parts, blend)) }
    };
    // SAFETY: pointers as the header asks.
    unsafe { construct(out_geom, build) }
}

/// The points of `from` that are in none of `count` bodies, with the edges between them rounded: the complement of
/// the smooth union of from's complement and the bodies. Otherwise as emb_geom_smooth_union.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_smooth_difference(
    from: *const emb_geom,
    count: usize,
    remove: *const *const emb_geom,
    blend: *const emb_blend,
    out_geom: *mut *mut emb_geom,
) -> emb_status {
    let build = || {
        // SAFETY: pointers as the header asks.
        let (from, remove) = unsafe { (lend("from", from)?, bodies("remove", count, remove)?) };
        // SAFETY: as above.
        unsafe { emb_blend::lend(blend, |blend| from.smooth_difference(&remove, blend)) }
    };
    // SAFETY: pointers as the header asks.
    unsafe { construct(out_geom, build) }
}

/// The union of copies of g at (i period[0], j period[1], k period[2]), 0 <= i < counts[0] and so on, without the
/// copies: of the memory of one, and only those near a point are asked. A period may be negative, or zero, which
/// leaves all copies along that axis in one place. Exact where g is and its bounds are smaller than the period. Labels are g's. O(1), shares g.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (not finite, a count below 1),
/// EMB_ERROR_UNSUPPORTED (more than 2^20 copies may be at one point: of a body without bounds all of them).
/// cbindgen:ptrs-as-arrays=[[period;3], [counts;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_repeat(
    g: *const emb_geom,
    period: *const f64,
    counts: *const i32,
    out_geom: *mut *mut emb_geom,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    unsafe { construct(out_geom, || lend("g", g)?.repeat(numbers("period", period)?, integers("counts", counts)?)) }
}

/// The geometry cut down to what matters within the finite box [lo, hi] (Duff 1992): parts of unions, intersections
/// and blends that lose against another everywhere in the box are left out. Within the box the values have the same
/// bits; outside of it they mean nothing. For a block of a grid that many parts are far from. Cost: one range of
/// values for each part. Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT.
/// cbindgen:ptrs-as-arrays=[[lo;3], [hi;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_simplify(
    g: *const emb_geom,
    lo: *const f64,
    hi: *const f64,
    out_geom: *mut *mut emb_geom,
) -> emb_status {
    let build = || {
        // SAFETY: pointers as the header asks.
        let (g, lo, hi) = unsafe { (lend("g", g)?, numbers::<3>("lo", lo)?, numbers::<3>("hi", hi)?) };
        g.simplified(Aabb::new(Vec3::from(lo), Vec3::from(hi)))
    };
    // SAFETY: pointers as the header asks.
    unsafe { construct(out_geom, build) }
}
