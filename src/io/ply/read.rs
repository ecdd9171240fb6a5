// SPDX-License-Identifier: MIT OR Apache-2.0
//! The items of a PLY file: vertices, faces and strips; other elements are stepped over.

use super::header::{self, Element, Header, Property, Shape, Vector};
use super::numbers::Numbers;
use crate::error::{Error, Result, Status, try_with_capacity};
use crate::io::number::Number;
use crate::io::proportion::Demand;
use crate::math::Vec3;
use crate::mesh::{Faces, Field, FieldType, Input, LARGEST_COORDINATE};

/// Reads a file.
pub(in crate::io) fn read(bytes: &[u8]) -> Result<Input> {
    let header = header::read(bytes)?;
    check_elements(&header)?;
    let vertex = header.elements.iter().find(|e| e.is("vertex"));
    let vertices = vertex.map_or(0, |e| e.count);
    if let Some(element) = vertex.filter(|e| e.count >= u32::MAX as usize) {
        return Err(element.wrong(format_args!("{vertices} are more than {}", u32::MAX - 1)));
    }
    let mut numbers = Numbers::new(bytes, header.end, header.lines, header.encoding);
    let mut input = Input::new(Vec::new(), Faces::with_capacity(0, 0)?, Status::Parse);
    for element in &header.elements {
        check_claim(&header, element, &numbers)?;
        if element.is("vertex") && input.positions.is_empty() {
            read_vertices(element, &mut numbers, &mut input)?;
        } else if element.is("face") {
            read_faces(element, vertices, &mut numbers, &mut input)?;
        } else if element.is("tristrips") {
            read_strips(element, vertices, &mut numbers, &mut input)?;
        } else if !element.properties.is_empty() {
            for _ in 0..element.count {
                element.properties.iter().try_for_each(|p| skip(p, &mut numbers))?;
            }
        }
    }
    if input.faces.len() == 0 {
        return Err(Error::parse(format!("{}: the file has no face of three corners", numbers.place())));
    }
    input.tag_names = header.tag_names;
    for vector in &header.vectors {
        join(vector, if vector.on_faces { &mut input.face_data } else { &mut input.vertex_data })?;
    }
    let count = input.numbers;
    input.face_data.iter_mut().for_each(|f| f.pad(count));
    if !input.tags.is_empty() {
        input.tags.resize(count, 0);
    }
    Ok(input)
}

/// Each element that matters comes once, and data of faces belong to all of them.
fn check_elements(header: &Header) -> Result<()> {
    let all = |name: &'static str| header.elements.iter().filter(move |e| e.is(name) && e.count > 0);
    for name in ["vertex", "face", "tristrips"] {
        if let Some(second) = all(name).nth(1) {
            return Err(second.wrong("it is there twice"));
        }
    }
    let has_data = |e: &Element| e.properties.iter().any(|p| matches!(p.shape, Shape::Scalar(_)));
    if let (Some(_), Some(face)) = (all("tristrips").next(), all("face").find(|e| has_data(e))) {
        let what = face.wrong("it has data, and the element tristrips beside it has none");
        return Err(Error::unsupported(what.message()));
    }
    Ok(())
}

/// Nothing is allocated by the claim alone.
fn check_claim(header: &Header, element: &Element, numbers: &Numbers) -> Result<()> {
    let needed = element.count.checked_mul(element.least_bytes(header.encoding));
    // The last number of a text needs no space behind it.
    if needed.is_none_or(|n| n > numbers.left() + 1) {
        return Err(Error::parse(format!(
            "{}: the {} bytes left cannot hold {} items of the element \"{}\"",
            numbers.place(),
            numbers.left(),
            element.count,
            element.name
        )));
    }
    Ok(())
}

fn read_vertices(element: &Element, numbers: &mut Numbers, input: &mut Input) -> Result<()> {
    let is = |p: &Property, name: &str| p.name.eq_ignore_ascii_case(name) && matches!(p.shape, Shape::Scalar(_));
    for axis in ["x", "y", "z"] {
        if !element.properties.iter().any(|p| is(p, axis)) {
            return Err(element.wrong(format_args!("it has no property {axis}")));
        }
    }
    enum Goes {
        Axis(usize, Number),
        Field(usize, Number),
        Nowhere,
    }
    let mut plan = Vec::new();
    for p in &element.properties {
        let axis = ["x", "y", "z"].iter().position(|a| is(p, a));
        plan.push(match (axis, p.shape) {
            (Some(axis), Shape::Scalar(t)) => Goes::Axis(axis, t),
            (None, Shape::Scalar(t)) => {
                input.vertex_data.push(field(&p.name, element.count)?);
                Goes::Field(input.vertex_data.len() - 1, t)
            }
            _ => Goes::Nowhere,
        });
    }
    input.positions = try_with_capacity("vertices", element.count)?;
    for v in 0..element.count {
        let mut position = Vec3::ZERO;
        for (goes, p) in plan.iter().zip(&element.properties) {
            match *goes {
                Goes::Axis(axis, t) => position[axis] = coordinate(v, numbers.next(t)?, numbers)?,
                Goes::Field(k, t) => input.vertex_data[k].values.push(numbers.next(t)?),
                Goes::Nowhere => skip(p, numbers)?,
            }
        }
        input.positions.push(position);
    }
    for goes in plan {
        if let Goes::Field(k, t) = goes {
            let field = &mut input.vertex_data[k];
            field.kind = t.field_type(&field.values);
        }
    }
    Ok(())
}

fn coordinate(vertex: usize, x: f64, numbers: &Numbers) -> Result<f64> {
    if x.is_finite() && x.abs() <= LARGEST_COORDINATE {
        return Ok(x);
    }
    Err(Error::parse(format!("{}: the coordinate {x} of vertex {vertex} is not finite", numbers.place())))
}

fn field(name: &str, count: usize) -> Result<Field> {
    Ok(Field {
        name: name.to_owned(),
        kind: FieldType::F64,
        components: 1,
        values: try_with_capacity("values", count)?,
    })
}

/// The list that holds the corners.
fn corners_of(element: &Element) -> Result<usize> {
    let named = |p: &Property| ["vertex_indices", "vertex_index"].iter().any(|n| p.name.eq_ignore_ascii_case(n));
    let lists = |p: &Property| matches!(p.shape, Shape::List { item, .. } if item.is_integer());
    element
        .properties
        .iter()
        .position(|p| named(p) && lists(p))
        .ok_or_else(|| element.wrong("it has no list of integers vertex_indices"))
}

fn read_faces(element: &Element, vertices: usize, numbers: &mut Numbers, input: &mut Input) -> Result<()> {
    let corners = corners_of(element)?;
    let mut fields = Vec::new();
    for p in &element.properties {
        fields.push(match p.shape {
            Shape::Scalar(t) => Some((t, field(&p.name, element.count)?)),
            Shape::List { .. } => None,
        });
    }
    let mut ring = Vec::new();
    for _ in 0..element.count {
        let number = next_number(input, numbers)?;
        for (k, p) in element.properties.iter().enumerate() {
            match &mut fields[k] {
                Some((t, field)) => field.values.push(numbers.next(*t)?),
                None if k == corners => read_ring(p, number, vertices, numbers, false, &mut ring)?,
                None => skip(p, numbers)?,
            }
        }
        if ring.len() > 2 {
            push(input, ring.iter().map(|v| *v as u32), number)?;
        }
    }
    for (t, mut field) in fields.into_iter().flatten() {
        field.kind = t.field_type(&field.values);
        let fits = |x: &f64| *x >= f64::from(i32::MIN) && *x <= f64::from(i32::MAX);
        let whole = t.is_integer() && field.values.iter().all(fits);
        if field.name.eq_ignore_ascii_case("tag") && whole && input.tags.is_empty() {
            input.tags = try_with_capacity("tags", field.values.len())?;
            input.tags.extend(field.values.iter().map(|x| *x as i32));
        } else {
            input.face_data.push(field);
        }
    }
    Ok(())
}

/// The triangles of strips: each corner after the first two of a strip closes one, and -1 begins another strip.
fn read_strips(element: &Element, vertices: usize, numbers: &mut Numbers, input: &mut Input) -> Result<()> {
    let corners = corners_of(element)?;
    let size = numbers.size();
    let mut ring = Vec::new();
    for strip in 0..element.count {
        for (k, p) in element.properties.iter().enumerate() {
            if k == corners {
                read_ring(p, strip as u32, vertices, numbers, true, &mut ring)?;
            } else {
                skip(p, numbers)?;
            }
        }
        // Triangles without area join the pieces of a strip.
        let has_area = |t: &&[i64]| t.iter().all(|v| *v >= 0) && t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
        let faces = ring.windows(3).filter(has_area).count();
        let corners = input.faces.corners.len().saturating_add(faces.saturating_mul(3));
        Demand { points: vertices, corners, ..Demand::default() }.check(size)?;
        for strip in ring.split(|v| *v < 0) {
            for (k, t) in strip.windows(3).enumerate() {
                let (a, b) = if k % 2 == 0 { (t[0], t[1]) } else { (t[1], t[0]) };
                if has_area(&t) {
                    let number = next_number(input, numbers)?;
                    push(input, [a, b, t[2]].into_iter().map(|v| v as u32), number)?;
                }
            }
        }
    }
    Ok(())
}

/// Makes one field of those of its components, where they stand side by side.
fn join(vector: &Vector, fields: &mut Vec<Field>) -> Result<()> {
    let is_component = |c: usize, f: &Field| f.name == vector.property(c) && f.components == 1;
    let Some(first) = fields.iter().position(|f| is_component(0, f)) else { return Ok(()) };
    let found = fields[first..].iter().take(vector.components).enumerate().filter(|(c, f)| is_component(*c, f));
    let items = fields[first].values.len();
    if found.count() < vector.components || fields.iter().any(|f| f.name == vector.name && vector.components > 1) {
        return Ok(());
    }
    let mut values = try_with_capacity("values", items * vector.components)?;
    for k in 0..items {
        values.extend(fields[first..first + vector.components].iter().map(|f| f.values[k]));
    }
    // No other type holds what several do.
    let same = fields[first..first + vector.components].iter().all(|f| f.kind == fields[first].kind);
    let kind = if same { fields[first].kind } else { FieldType::F64 };
    fields.drain(first + 1..first + vector.components);
    fields[first] = Field { name: vector.name.clone(), kind, components: vector.components, values };
    Ok(())
}

fn next_number(input: &mut Input, numbers: &Numbers) -> Result<u32> {
    let number = u32::try_from(input.numbers).ok().filter(|n| *n < u32::MAX);
    input.numbers += 1;
    number.ok_or_else(|| Error::parse(format!("{}: more than {} faces", numbers.place(), u32::MAX - 1)))
}

fn push(input: &mut Input, corners: impl ExactSizeIterator<Item = u32>, number: u32) -> Result<()> {
    let faces = &mut input.faces;
    let total = faces.corners.len() + corners.len();
    if u32::try_from(total).is_err() {
        return Err(Error::parse(format!("face {number}: more than {} corners", u32::MAX)));
    }
    let reserved = faces.corners.try_reserve(corners.len()).and(faces.start.try_reserve(1));
    reserved.and(faces.input.try_reserve(1)).map_err(|_| Error::memory("corners", total))?;
    faces.push_all(corners, number);
    Ok(())
}

/// The indices of a list; `breaks` lets -1 stand among them.
fn read_ring(
    p: &Property,
    item: u32,
    vertices: usize,
    numbers: &mut Numbers,
    breaks: bool,
    ring: &mut Vec<i64>,
) -> Result<()> {
    let Shape::List { count, item: t } = p.shape else { return Ok(()) };
    let length = length(count, numbers)?;
    ring.clear();
    ring.try_reserve(length).map_err(|_| Error::memory("corners", length))?;
    for _ in 0..length {
        let index = numbers.next(t)?;
        let known = index >= 0.0 && index < vertices as f64 && index.fract() == 0.0;
        if !(known || breaks && index == -1.0) {
            return Err(Error::parse(format!(
                "{}: the index {index} of face {item} does not count one of {vertices} vertices",
                numbers.place()
            )));
        }
        ring.push(index as i64);
    }
    Ok(())
}

/// The length of a list, which the bytes left must hold.
fn length(t: Number, numbers: &mut Numbers) -> Result<usize> {
    let length = numbers.next(t)?;
    if length >= 0.0 && length <= numbers.left() as f64 && length.fract() == 0.0 {
        return Ok(length as usize);
    }
    Err(Error::parse(format!("{}: the {} bytes left cannot hold a list of {length}", numbers.place(), numbers.left())))
}

fn skip(p: &Property, numbers: &mut Numbers) -> Result<()> {
    match p.shape {
        Shape::Scalar(t) => numbers.next(t).map(|_| ()),
        Shape::List { count, item } => {
            for _ in 0..length(count, numbers)? {
                numbers.next(item)?;
            }
            Ok(())
        }
    }
}
