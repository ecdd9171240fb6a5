// SPDX-License-Identifier: MIT OR Apache-2.0
//! Values over grids written as VTI and VTR: what is in the file, and what is refused.

use embound::Status;
use embound::io::{GridField, write_grid};
use embound::mesh::FieldType;
use std::fs;
use std::path::PathBuf;

fn path(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("vti");
    fs::create_dir_all(&folder).unwrap();
    folder.join(name)
}

/// A file cut into its head and its data.
struct Parsed {
    head: String,
    data: Vec<u8>,
}

impl Parsed {
    fn of(bytes: &[u8]) -> Parsed {
        let mark = b"<AppendedData encoding=\"raw\">\n_";
        let at = bytes.windows(mark.len()).position(|w| w == mark).expect("appended data");
        let end = b"\n</AppendedData>\n</VTKFile>\n";
        assert!(bytes.ends_with(end));
        let head = String::from_utf8(bytes[..at].to_vec()).expect("UTF-8");
        Parsed { head, data: bytes[at + mark.len()..bytes.len() - end.len()].to_vec() }
    }

    /// The arrays as (type, name, bytes), in the order of the head.
    fn arrays(&self) -> Vec<(String, String, Vec<u8>)> {
        let value = |line: &str, key: &str| {
            let rest = line.split_once(&format!(" {key}=\"")).expect(key).1;
            rest.split('"').next().unwrap().to_owned()
        };
        let lines: Vec<&str> = self.head.lines().filter(|l| l.starts_with("<DataArray ")).collect();
        let mut end = 0;
        let arrays = lines.iter().map(|line| {
            let at: usize = value(line, "offset").parse().unwrap();
            assert_eq!(at, end, "arrays lie one behind the other");
            let size = u64::from_le_bytes(self.data[at..at + 8].try_into().unwrap()) as usize;
            end = at + 8 + size;
            (value(line, "type"), value(line, "Name"), self.data[at + 8..end].to_vec())
        });
        let arrays = arrays.collect();
        assert_eq!(end, self.data.len(), "nothing is left over");
        arrays
    }
}

const X: [f64; 4] = [-1.0, -0.5, 0.0, 0.5];
const Y: [f64; 3] = [2.0, 4.0, 6.0];
const Z: [f64; 2] = [0.1, 0.30000000000000004];

/// Different at every node.
fn value(i: usize, j: usize, k: usize) -> f64 {
    (i + 10 * j + 30 * k) as f64 + 0.25
}

fn field(name: &str, kind: FieldType) -> GridField<'_> {
    GridField::new(name, kind, |j, k, out| out.iter_mut().enumerate().for_each(|(i, x)| *x = value(i, j, k)))
}

/// The values of all nodes, x fastest.
fn all<T>(of: impl Fn(f64) -> T) -> Vec<T> {
    let nodes = (0..2).flat_map(|k| (0..3).flat_map(move |j| (0..4).map(move |i| (i, j, k))));
    nodes.map(|(i, j, k)| of(value(i, j, k))).collect()
}

fn assert_values(arrays: &[(String, String, Vec<u8>)]) {
    let bytes = |k: usize| (arrays[k].0.as_str(), arrays[k].1.as_str(), arrays[k].2.as_slice());
    assert_eq!(bytes(0), ("Float64", "a", all(f64::to_le_bytes).as_flattened()));
    assert_eq!(bytes(1), ("Float32", "b &lt;&amp;&gt;", all(|x| (x as f32).to_le_bytes()).as_flattened()));
    assert_eq!(bytes(2), ("Int32", "c", all(|x| (x as i32).to_le_bytes()).as_flattened()));
    assert_eq!(bytes(3), ("Int8", "d", all(|x| (x as i8).to_le_bytes()).as_flattened()));
}

fn fields() -> [GridField<'static>; 4] {
    [("a", FieldType::F64), ("b <&>", FieldType::F32), ("c", FieldType::I32), ("d", FieldType::I8)]
        .map(|(n, k)| field(n, k))
}

#[test]
fn a_vti_file_holds_origin_step_and_all_values() {
    let path = path("a.vti");
    write_grid(&path, [&X, &Y, &Z], &fields()).unwrap();
    let parsed = Parsed::of(&fs::read(&path).unwrap());
    assert!(
        parsed.head.contains(
            "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">"
        )
    );
    let image =
        "<ImageData WholeExtent=\"0 3 0 2 0 1\" Origin=\"-1.0 2.0 0.1\" Spacing=\"0.5 2.0 0.20000000000000004\">";
    assert!(parsed.head.contains(image), "{}", parsed.head);
    assert!(parsed.head.contains("<Piece Extent=\"0 3 0 2 0 1\">\n<PointData Scalars=\"a\">\n"));
    assert_eq!(parsed.arrays().len(), 4);
    assert_values(&parsed.arrays());
}

#[test]
fn a_vtr_file_holds_the_coordinates_to_the_bit() {
    let x = [-1.0, -0.9999999999999999, 1e-300, 1e9];
    let path = path("a.VTR");
    write_grid(&path, [&x, &Y, &Z], &fields()).unwrap();
    let parsed = Parsed::of(&fs::read(&path).unwrap());
    assert!(parsed.head.contains("<RectilinearGrid WholeExtent=\"0 3 0 2 0 1\">\n<Piece Extent=\"0 3 0 2 0 1\">\n"));
    let arrays = parsed.arrays();
    assert_values(&arrays);
    for (array, axis) in arrays[4..].iter().zip([&x[..], &Y, &Z]) {
        assert_eq!(array.0, "Float64");
        assert!(array.2.chunks(8).map(|b| f64::from_le_bytes(b.try_into().unwrap())).eq(axis.iter().copied()));
    }
    let names: Vec<&str> = arrays[4..].iter().map(|a| a.1.as_str()).collect();
    assert_eq!(names, ["x", "y", "z"]);
}

#[test]
fn a_plane_a_line_and_a_point_are_grids_too() {
    let one = [7.0];
    for (axes, extent) in
        [([&X[..], &Y, &one], "0 3 0 2 0 0"), ([&X, &one, &one], "0 3 0 0 0 0"), ([&one, &one, &one], "0 0 0 0 0 0")]
    {
        for name in ["flat.vti", "flat.vtr"] {
            write_grid(&path(name), axes, &[field("a", FieldType::F64)]).unwrap();
            let parsed = Parsed::of(&fs::read(path(name)).unwrap());
            assert!(parsed.head.contains(&format!("WholeExtent=\"{extent}\"")), "{}", parsed.head);
            let points: usize = axes.iter().map(|a| a.len()).product();
            assert_eq!(parsed.arrays()[0].2.len(), 8 * points);
        }
    }
    write_grid(&path("none.vti"), [&X, &Y, &Z], &[]).unwrap();
    assert!(Parsed::of(&fs::read(path("none.vti")).unwrap()).arrays().is_empty());
}

#[test]
fn steps_are_even_to_within_rounding_at_any_scale_and_place() {
    for scale in [1e-6, 1.0, 1e3, 1e-150, 1e150] {
        for origin in [0.0, -3.7, 1000.0] {
            let step = scale / 3.0;
            let product: Vec<f64> = (0..1000).map(|i| origin * scale + i as f64 * step).collect();
            let mut sum = vec![origin * scale];
            (1..1000).for_each(|i| sum.push(sum[i - 1] + step));
            let from_centre: Vec<f64> = (0..1000).map(|i| (origin + (i as f64 - 499.5) / 3.0) * scale).collect();
            for axis in [&product, &sum, &from_centre] {
                write_grid(&path("even.vti"), [axis, &Y, &Z], &[]).unwrap();
            }
            let mut uneven = product.clone();
            uneven[500] += 1e-6 * step;
            let error = write_grid(&path("even.vti"), [&uneven, &Y, &Z], &[]).unwrap_err();
            assert_eq!(error.status(), Status::Unsupported);
            assert!(
                error.message().contains("even.vti: x[500]: ") && error.message().ends_with(".vtr takes any"),
                "{error}"
            );
            write_grid(&path("even.vtr"), [&uneven, &Y, &Z], &[]).unwrap();
        }
    }
}

#[test]
fn what_a_file_cannot_hold_is_refused_and_the_old_file_stays() {
    let falling = [1.0, 0.0];
    let repeated = [0.0, 1.0, 1.0];
    let infinite = [0.0, f64::INFINITY];
    let named = |name| [field("a", FieldType::F64), field(name, FieldType::F64)];
    for (name, axes, fields, status, wanted) in [
        ("b.vti", [&X[..], &Y, &falling], named("b"), Status::Unsupported, "b.vti: z[1]: 0 after 1 does not rise"),
        ("b.vtr", [&X, &repeated, &Z], named("b"), Status::Unsupported, "b.vtr: y[2]: 1 after 1 does not rise"),
        ("b.vtr", [&infinite, &Y, &Z], named("b"), Status::InvalidArgument, "b.vtr: x[1]: inf is not finite"),
        (
            "b.vtr",
            [&X, &[], &Z],
            named("b"),
            Status::InvalidArgument,
            "b.vtr: y: no nodes: a file has at least one on each axis",
        ),
        (
            "b.vtk",
            [&X, &Y, &Z],
            named("b"),
            Status::Unsupported,
            "the extension \"vtk\" is of no format of grids: .vti, .vtr",
        ),
        ("b.vti", [&X, &Y, &Z], named(""), Status::InvalidArgument, "names[1]: \"\" is empty"),
        ("b.vti", [&X, &Y, &Z], named("b\nc"), Status::InvalidArgument, "names[1]: \"b c\" is empty, not one line"),
        (
            "b.vti",
            [&X, &Y, &Z],
            named(" b"),
            Status::InvalidArgument,
            "names[1]: \" b\" is empty, not one line, or has blanks",
        ),
        ("b.vti", [&X, &Y, &Z], named("a"), Status::InvalidArgument, "names[1]: \"a\" is there already"),
    ] {
        fs::write(path(name), b"older").unwrap();
        let error = write_grid(&path(name), axes, &fields).unwrap_err();
        assert_eq!(error.status(), status, "{error}");
        assert!(error.message().contains(wanted), "{error}");
        assert_eq!(fs::read(path(name)).unwrap(), b"older");
    }
    let error = write_grid(&path("no/such/b.vti"), [&X, &Y, &Z], &[]).unwrap_err();
    assert!(error.status() == Status::Io && error.message().contains("b.vti: cannot write: No such file"), "{error}");
}
