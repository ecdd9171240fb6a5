// SPDX-License-Identifier: MIT OR Apache-2.0
//! Values over a grid for ParaView and VisIt, as VTK's XML image data or rectilinear grids (VTK User's Guide, "VTK
//! File Formats"): an XML head, an underscore, then for each array its size in 64 bits and its bytes, little-endian.

use super::number::Number;
use super::text::{Text, attribute, one_line};
use super::{file, named};
use crate::error::{Error, Result, try_with_capacity};
use crate::mesh::FieldType;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

/// Gives row (j, k): a value for each node along x.
type Row<'a> = Box<dyn Fn(usize, usize, &mut [f64]) + 'a>;

/// Named values at the nodes of a grid.
pub struct GridField<'a> {
    name: &'a str,
    kind: FieldType,
    row: Row<'a>,
}

impl<'a> GridField<'a> {
    /// Values that are written as `kind`; `row(j, k, out)` gives those of the nodes (0, j, k), (1, j, k), ...
    ///
    /// ```
    /// # use embound::{io::{GridField, write_grid}, mesh::FieldType};
    /// let x = [0.0, 0.5, 1.0];
    /// let field = GridField::new("x + j", FieldType::F32, |j, _k, out| {
    ///     out.iter_mut().zip(x).for_each(|(value, x)| *value = x + j as f64);
    /// });
    /// # let path = std::env::temp_dir().join(format!("embound-{}.vti", std::process::id()));
    /// write_grid(&path, [&x, &x, &[0.0]], &[field])?;
    /// # std::fs::remove_file(&path).unwrap();
    /// # Ok::<(), embound::Error>(())
    /// ```
    pub fn new(name: &'a str, kind: FieldType, row: impl Fn(usize, usize, &mut [f64]) + 'a) -> GridField<'a> {
        GridField { name, kind, row: Box::new(row) }
    }
}

/// Writes values at the nodes (x\[i\], y\[j\], z\[k\]) of a grid. `.vti` wants axes of even steps and keeps the first
/// node and the step alone; `.vtr` takes every rising axis and keeps its coordinates. One row is in memory at a time;
/// the file appears under its name when it is complete.
///
/// # Errors
/// [`Status::Unsupported`](crate::Status) for another extension, and for an axis that does not rise strictly
/// or, with `.vti`, not evenly: that a node lies farther from where it belongs than what rounding sums up to;
/// [`Status::InvalidArgument`](crate::Status) for an axis without nodes or with one that is not finite, and for a name
/// that is empty, not one line or there already; [`Status::Io`](crate::Status) with the path and the system's reason.
pub fn write_grid(path: &Path, axes: [&[f64]; 3], fields: &[GridField]) -> Result<()> {
    let head = head(path, axes, fields).map_err(|e| named(path, &e))?;
    let [nx, ny, nz] = axes.map(<[f64]>::len);
    let mut row = try_with_capacity("values", nx)?;
    row.resize(nx, 0.0);
    let mut bytes = try_with_capacity("bytes", nx.max(axes.iter().map(|a| a.len()).max().unwrap_or(0)) * 8)?;
    file::write_with(path, |file| {
        let mut out = BufWriter::with_capacity(1 << 20, file);
        out.write_all(&head.text)?;
        for field in fields {
            let number = Number::of_field(field.kind);
            out.write_all(&((nx * ny * nz * number.size()) as u64).to_le_bytes())?;
            for (k, j) in (0..nz).flat_map(|k| (0..ny).map(move |j| (k, j))) {
                (field.row)(j, k, &mut row);
                put(&mut out, number, &row, &mut bytes)?;
            }
        }
        if head.with_coordinates {
            for axis in axes {
                out.write_all(&(8 * axis.len() as u64).to_le_bytes())?;
                put(&mut out, Number::F64, axis, &mut bytes)?;
            }
        }
        out.write_all(b"\n</AppendedData>\n</VTKFile>\n")?;
        out.flush()
    })
}

/// Writes numbers, in memory that is there.
fn put(out: &mut BufWriter<&mut File>, number: Number, values: &[f64], bytes: &mut Vec<u8>) -> io::Result<()> {
    bytes.clear();
    values.iter().for_each(|x| number.encode(*x, bytes));
    out.write_all(bytes)
}

/// What comes before the data.
struct Head {
    text: Vec<u8>,
    /// Whether the coordinates of the axes come behind the fields.
    with_coordinates: bool,
}

fn head(path: &Path, axes: [&[f64]; 3], fields: &[GridField]) -> Result<Head> {
    let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
    let with_coordinates = match extension.to_str() {
        Some("vti") => false,
        Some("vtr") => true,
        _ => {
            let what = format!("the extension \"{}\" is of no format of grids: .vti, .vtr", extension.display());
            return Err(Error::unsupported(what));
        }
    };
    for (name, axis) in ["x", "y", "z"].into_iter().zip(axes) {
        check_axis(name, axis, with_coordinates)?;
    }
    check_names(fields)?;
    let [nx, ny, nz] = axes.map(<[f64]>::len);
    let points = nx.checked_mul(ny).and_then(|n| n.checked_mul(nz)).filter(|n| *n <= isize::MAX as usize / 8);
    let points = points.ok_or_else(|| Error::invalid(format!("x, y, z: {nx} x {ny} x {nz} nodes overflow")))?;

    let mut text = Text::default();
    let extent = format!("0 {} 0 {} 0 {}", nx - 1, ny - 1, nz - 1);
    let (element, geometry) = if with_coordinates {
        ("RectilinearGrid", String::new())
    } else {
        let [x, y, z] = axes.map(|axis| axis[0]);
        let [dx, dy, dz] = axes.map(step);
        ("ImageData", format!(" Origin=\"{x:?} {y:?} {z:?}\" Spacing=\"{dx:?} {dy:?} {dz:?}\""))
    };
    text.add(format_args!(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"{element}\" version=\"1.0\" byte_order=\"LittleEndian\" \
         header_type=\"UInt64\">\n<{element} WholeExtent=\"{extent}\"{geometry}>\n<Piece Extent=\"{extent}\">\n"
    ))?;
    let mut offset = 0u64;
    let mut array = |text: &mut Text, number: Number, name: &str, count: usize| {
        let (kind, name) = (number.name(), attribute(name));
        text.add(format_args!(
            "<DataArray type=\"{kind}\" Name=\"{name}\" format=\"appended\" offset=\"{offset}\"/>\n"
        ))?;
        offset = offset.saturating_add(8 + (count * number.size()) as u64);
        Ok(())
    };
    let first = fields.first().map_or(String::new(), |f| format!(" Scalars=\"{}\"", attribute(f.name)));
    text.add(format_args!("<PointData{first}>\n"))?;
    for field in fields {
        array(&mut text, Number::of_field(field.kind), field.name, points)?;
    }
    text.add(format_args!("</PointData>\n"))?;
    if with_coordinates {
        text.add(format_args!("<Coordinates>\n"))?;
        for (name, axis) in ["x", "y", "z"].into_iter().zip(axes) {
            array(&mut text, Number::F64, name, axis.len())?;
        }
        text.add(format_args!("</Coordinates>\n"))?;
    }
    text.add(format_args!("</Piece>\n</{element}>\n<AppendedData encoding=\"raw\">\n_"))?;
    Ok(Head { text: text.into_bytes(), with_coordinates })
}

fn check_names(fields: &[GridField]) -> Result<()> {
    for (k, field) in fields.iter().enumerate() {
        let name = field.name;
        if name.is_empty() || one_line(name) != name {
            return Err(Error::invalid(format!(
                "names[{k}]: \"{name}\" is empty, not one line, or has blanks around it"
            )));
        }
        if fields[..k].iter().any(|f| f.name == name) {
            return Err(Error::invalid(format!("names[{k}]: \"{name}\" is there already")));
        }
    }
    Ok(())
}

/// Rising, and where the file does not keep the coordinates, in even steps.
fn check_axis(name: &str, axis: &[f64], any_steps: bool) -> Result<()> {
    if axis.is_empty() {
        return Err(Error::invalid(format!("{name}: no nodes: a file has at least one on each axis")));
    }
    if let Some(i) = axis.iter().position(|x| !x.is_finite()) {
        return Err(Error::invalid(format!("{name}[{i}]: {} is not finite", axis[i])));
    }
    if let Some(i) = axis.windows(2).position(|w| w[0] >= w[1]) {
        let [a, b] = [axis[i], axis[i + 1]];
        return Err(Error::unsupported(format!("{name}[{}]: {b} after {a} does not rise", i + 1)));
    }
    let largest = axis[0].abs().max(axis[axis.len() - 1].abs());
    // Half a unit in the last place for each addition of a step, and as much for what it is compared with.
    let allowed = (axis.len() + 4) as f64 * f64::EPSILON * largest;
    let even = |i: usize| axis[0] + i as f64 * step(axis);
    match (0..axis.len()).find(|&i| !any_steps && (axis[i] - even(i)).abs() > allowed) {
        None => Ok(()),
        Some(i) => Err(Error::unsupported(format!(
            "{name}[{i}]: {} is not the {} of even steps, which .vti needs; .vtr takes any",
            axis[i],
            even(i)
        ))),
    }
}

/// The mean step of an axis; 1 where it has a single node, since VTK takes no step of 0.
fn step(axis: &[f64]) -> f64 {
    match axis.len() {
        0 | 1 => 1.0,
        // Halves do not overflow.
        n => 2.0 * ((axis[n - 1] / 2.0 - axis[0] / 2.0) / (n - 1) as f64),
    }
}
