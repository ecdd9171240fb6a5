// SPDX-License-Identifier: MIT OR Apache-2.0
//! Tags and their names, and named data of vertices and faces, also at points of the surface.

use super::arrays::{elements, slice, strided};
use super::constants::{EMB_ON_FACES, EMB_ON_VERTICES};
use super::error::{emb_status, guard};
use super::handle::{give, lend, null, writable};
use super::lists::{give_list, give_text, portion};
use super::mesh::emb_mesh;
use super::run::{emb_run, with_run};
use super::versioned::{self, Versioned};
use super::writer::Writer;
use crate::error::{Error, Result, try_copy, try_with_capacity};
use crate::math::Vec3;
use crate::mesh::{Field, FieldType, Mesh};
use std::ffi::{CStr, c_char};
use std::mem::{offset_of, size_of};

/// Points interpolated per chunk of work.
const CHUNK: usize = 1024;

/// What named data of a mesh are like.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct emb_mesh_field {
    /// sizeof(emb_mesh_field), set by the caller
    pub struct_size: usize,
    /// Numbers for each vertex or face.
    pub components: usize,
    /// Items: for EMB_ON_FACES one for each input face; for EMB_ON_VERTICES one for each vertex, item v that of vertex
    /// v, and behind them those of other corners of vertices whose data differ between faces (seams).
    pub count: usize,
}

// SAFETY: repr(C), size first, numbers.
unsafe impl Versioned for emb_mesh_field {
    const FIRST_SIZE: usize = offset_of!(emb_mesh_field, count) + size_of::<usize>();
    const DEFAULT: emb_mesh_field =
        emb_mesh_field { struct_size: size_of::<emb_mesh_field>(), components: 0, count: 0 };
}

/// Copies the tags of the input faces first .. first + count - 1; 0 where the mesh has none.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (beyond the last face). Any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_face_tags(
    mesh: *const emb_mesh,
    first: usize,
    count: usize,
    out_tags: *mut i32,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let mesh = lend("mesh", mesh)?;
        let range = portion("faces", first, count, mesh.face_count())?;
        Writer::required("out_tags", out_tags, count)?.put([0; 3], range.map(|f| mesh.tag(f as u32)));
        Ok(())
    })
}

/// The different tags of the faces as they stand, ascending: *out_count of them; with `capacity` 0 that is all, else
/// out_tags takes them. Cost: O(n log n). Any thread.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (a capacity below the count), EMB_ERROR_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_tags(
    mesh: *const emb_mesh,
    capacity: usize,
    out_tags: *mut i32,
    out_count: *mut usize,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let tags = lend("mesh", mesh)?.used_tags()?;
        give_list("out_tags", &tags, capacity, out_tags, out_count)
    })
}

/// The name of a tag: of the file's solid, group or material, or of the file; "" where it has none. *out_size is its
/// size, the zero byte at the end counted; with `capacity` 0 that is all, else out_name takes it. Any thread.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (a capacity below the size).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_tag_name(
    mesh: *const emb_mesh,
    tag: i32,
    capacity: usize,
    out_name: *mut c_char,
    out_size: *mut usize,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let mesh = lend("mesh", mesh)?;
        give_text("out_name", mesh.tag_name(tag).unwrap_or(""), capacity, out_name, out_size)
    })
}

/// The mesh with other tags: one number for each input face (emb_mesh_face_count of them), and `name_count` names, each
/// for the tag at the same place of `named_tags`. Tags, names and no others: those of before are gone. A tag that no face
/// has may have a name, which emb_mesh_tag_name tells; emb_mesh_tags does not list it. A field of ids becomes tags by
/// emb_mesh_field_values and this. Cost: linear; the mesh is copied.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (a name that is empty, not UTF-8, not one line or has
/// white space around it; a tag named twice), EMB_ERROR_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_with_tags(
    mesh: *const emb_mesh,
    tags: *const i32,
    name_count: usize,
    named_tags: *const i32,
    names: *const *const c_char,
    out_mesh: *mut *mut emb_mesh,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let mesh = lend("mesh", mesh)?;
        let tags = slice("tags", tags, mesh.face_count())?;
        let name_count = elements::<(i32, String)>("name_count", name_count, 1)?;
        let numbers = slice("named_tags", named_tags, name_count)?;
        let mut named = try_with_capacity("names", name_count)?;
        for (k, text) in slice("names", names, name_count)?.iter().enumerate() {
            named.push((numbers[k], name(&format!("names[{k}]"), *text)?.to_owned()));
        }
        writable("out_mesh", out_mesh)?;
        give(out_mesh, mesh.with_tags(tags, named)?);
        Ok(())
    })
}

/// How many named data the vertices (EMB_ON_VERTICES) or faces (EMB_ON_FACES) of a mesh have. Any thread.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (on).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_field_count(mesh: *const emb_mesh, on: i32, out_count: *mut usize) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let fields = fields(lend("mesh", mesh)?, on)?;
        writable("out_count", out_count)?;
        out_count.write(fields.len());
        Ok(())
    })
}

/// What the named data number k are like, and their name: *out_size is its size with the zero byte at the end; with
/// `capacity` 0 no name is written. field->struct_size is set by the caller; field may be NULL. Any thread.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (on, k, a capacity below the size).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_field_get(
    mesh: *const emb_mesh,
    on: i32,
    k: usize,
    field: *mut emb_mesh_field,
    capacity: usize,
    out_name: *mut c_char,
    out_size: *mut usize,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let known = self::field(lend("mesh", mesh)?, on, k)?;
        let size = if field.is_null() { None } else { Some(versioned::result_size("field", field)?) };
        give_text("out_name", &known.name, capacity, out_name, out_size)?;
        if let Some(size) = size {
            let count = known.values.len() / known.components;
            let result = emb_mesh_field { components: known.components, count, ..emb_mesh_field::DEFAULT };
            versioned::write_result(field, size, result);
        }
        Ok(())
    })
}

/// Copies the values of the items first .. first + count - 1 of the named data number k: components * count numbers.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (on, k, beyond the last item). Any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_field_values(
    mesh: *const emb_mesh,
    on: i32,
    k: usize,
    first: usize,
    count: usize,
    out_values: *mut f64,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let known = field(lend("mesh", mesh)?, on, k)?;
        let items = portion("items", first, count, known.values.len() / known.components)?;
        let out = Writer::required("out_values", out_values, known.components * count)?;
        out.put([0; 3], known.values[items.start * known.components..items.end * known.components].iter().copied());
        Ok(())
    })
}

/// The mesh with one more named field, or another in the place of one of the same name: `components` numbers for each
/// vertex as it stands (emb_mesh_vertex_count of them) or for each input face (emb_mesh_face_count). Vertices as they
/// stand are those that welding left, not those given: to give data for the latter, make the mesh with weld_tolerance -1
/// (emb_mesh_vertices says which vertex is which), add the data, and let emb_mesh_repair weld with EMB_REPAIR_WELD, which
/// keeps data that differ. Cost: linear; the mesh is copied.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (on, components 0, a name that is empty, not UTF-8, not
/// one line or has white space around it), EMB_ERROR_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_with_field(
    mesh: *const emb_mesh,
    on: i32,
    name: *const c_char,
    components: usize,
    values: *const f64,
    out_mesh: *mut *mut emb_mesh,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let mesh = lend("mesh", mesh)?;
        let on_faces = is_on_faces(on)?;
        let items = if on_faces { mesh.face_count() } else { mesh.vertices().len() };
        let name = self::name("name", name)?.to_owned();
        if components == 0 {
            return Err(Error::invalid("components: 0 is not at least 1"));
        }
        let given = slice("values", values, elements::<f64>("components", components, items)?)?;
        writable("out_mesh", out_mesh)?;
        let values = try_copy("values", given)?;
        give(out_mesh, mesh.with_field(on_faces, Field { name, kind: FieldType::F64, components, values })?);
        Ok(())
    })
}

/// The named data number k at `count` points of the surface, as emb_geom_closest names them: primitive[i] and piece[i]
/// (NULL: 0, which is right where all faces are triangles), and the barycentric weights barycentric[c][i * stride] of the
/// three corners. Data of vertices are interpolated linearly, data of faces are the face's. out_values takes `components`
/// numbers a point; NaN where primitive is -1 or no face of the mesh. A number of a face says nothing of its mesh: in a
/// composite geometry `mesh` must be the one that the closest part was made of, else the values are those of another
/// place, with no error. Ask each mesh for the points that are its own, by the parts of emb_geom_part. Where a face comes
/// to one place more than once, each of its corners there lies between two lobes of the face, and either lobe may take
/// the value of either. Any thread.
/// Errors: EMB_ERROR_NULL_ARGUMENT (barycentric may be NULL for EMB_ON_FACES), EMB_ERROR_INVALID_ARGUMENT (on, k, stride
/// 0), EMB_ERROR_CANCELLED. Cost: linear.
/// cbindgen:ptrs-as-arrays=[[barycentric;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_interpolate(
    mesh: *const emb_mesh,
    on: i32,
    k: usize,
    count: usize,
    primitive: *const i64,
    piece: *const i32,
    barycentric: *const *const f64,
    stride: usize,
    run: *const emb_run,
    out_values: *mut f64,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let mesh = lend("mesh", mesh)?;
        let known = field(mesh, on, k)?;
        let on_faces = is_on_faces(on)?;
        let reach = strided::<f64>(count, stride)?;
        let primitive = slice("primitive", primitive, elements::<i64>("count", count, 1)?)?;
        let piece = if piece.is_null() { &[] } else { slice("piece", piece, count)? };
        let weights = match (on_faces, count) {
            (false, 1..) => {
                let axes = slice("barycentric", barycentric, 3)?;
                [0, 1, 2].map(|c| slice(&format!("barycentric[{c}]"), axes[c], reach))
            }
            _ => [Ok(&[][..]), Ok(&[][..]), Ok(&[][..])],
        };
        let [x, y, z] = weights;
        let weights = [x?, y?, z?];
        let out = Writer::required("out_values", out_values, elements::<f64>("count", count, known.components)?)?;
        with_run(run, |run| {
            run.for_each_chunk(count.div_ceil(CHUNK), &|chunk| {
                let mut item = try_with_capacity("components", known.components)?;
                item.resize(known.components, 0.0);
                for i in chunk * CHUNK..count.min((chunk + 1) * CHUNK) {
                    let piece = piece.get(i).copied().unwrap_or(0);
                    if on_faces {
                        mesh.face_value(known, primitive[i], &mut item);
                    } else {
                        let at = Vec3::from_array(weights.map(|w| w[i * stride]));
                        mesh.interpolate(known, primitive[i], piece, at, &mut item);
                    }
                    out.put([i * known.components, 0, 0], item.iter().copied());
                }
                Ok(())
            })
        })
    })
}

fn is_on_faces(on: i32) -> Result<bool> {
    match on {
        EMB_ON_VERTICES => Ok(false),
        EMB_ON_FACES => Ok(true),
        other => Err(Error::invalid(format!("on: {other} is neither EMB_ON_VERTICES nor EMB_ON_FACES"))),
    }
}

fn fields(mesh: &Mesh, on: i32) -> Result<&[Field]> {
    Ok(if is_on_faces(on)? { mesh.face_fields() } else { mesh.vertex_fields() })
}

fn field(mesh: &Mesh, on: i32, k: usize) -> Result<&Field> {
    let fields = fields(mesh, on)?;
    let place = if on == EMB_ON_FACES { "faces" } else { "vertices" };
    fields.get(k).ok_or_else(|| match fields.len() {
        0 => Error::invalid(format!("k: {k}: the {place} of this mesh have no named data")),
        n => Error::invalid(format!("k: {k} is not below {n}, the count of named data of the {place}")),
    })
}

/// A name: one line of UTF-8.
///
/// # Safety
/// `text` is NULL or ends with a zero byte and stays during `'a`.
pub(super) unsafe fn name<'a>(argument: &str, text: *const c_char) -> Result<&'a str> {
    if text.is_null() {
        return Err(null(argument));
    }
    // SAFETY: the caller's promise.
    let text = unsafe { CStr::from_ptr(text) };
    match text.to_str() {
        Ok(name) if !name.is_empty() && !name.chars().any(char::is_control) => Ok(name),
        _ => Err(Error::invalid(format!("{argument}: {text:?} is empty, not UTF-8 or not one line"))),
    }
}
