// SPDX-License-Identifier: MIT OR Apache-2.0
//! Good files of every format, to be made wrong.

use crate::common::vtp_files::{Array, Form, Piece, Style, file, rich};
use crate::common::{Soup, bodies, obj_files, stl_bytes};

/// STL.
pub fn stl() -> Vec<Vec<u8>> {
    let sphere = bodies::icosphere(0);
    let several = stl_bytes::ascii_solid(&bodies::tetrahedron(), "one") + &stl_bytes::ascii_solid(&sphere, "two");
    vec![
        stl_bytes::binary(&sphere),
        stl_bytes::binary_with(&bodies::unit_cube().double_sided(), b"solid", 0x8123),
        stl_bytes::ascii(&bodies::unit_cube()),
        several.into_bytes(),
    ]
}

/// OBJ.
pub fn obj() -> Vec<Vec<u8>> {
    let texts = [
        obj_files::rich(),
        obj_files::plain(&bodies::icosphere(1)),
        obj_files::with_corners(&bodies::bracket(), |v| format!("/{v}/{v}")),
        "# tag 7 hot wall\ng a\nv 0 0 0 1 1 1\nv 1 0 0 0 0 0\nv 0 1 0 .5 .5 .5\nv 0 0 1 0 0 1\n# tag 3\ng b\nf 1 3 2\nf -4 \
         -3 -1\ng c\nusemtl m\nf 1/1 4/1 3/1\nf 2 3 4\n"
            .into(),
        "v 0 0 0\nv 3 0 0\nv 3 1 0\nv 1 1 0\nv 1 3 0\nv 0 3 0\nv 0 0 1\nf 6 5 4 3 2 1\nf 1 2 7\nf 2 3 7\nf 3 4 7\nf 4 5 7\nf 5 6 \
         7\nf 6 1 7\n"
            .into(),
    ];
    texts.map(String::into_bytes).to_vec()
}

/// VTP.
pub fn vtp() -> Vec<Vec<u8>> {
    let forms = [Form::Ascii, Form::Binary, Form::AppendedRaw, Form::AppendedBase64];
    let plain = forms.iter().map(|form| rich(Style::new(*form)));
    let packed =
        forms[1..].iter().map(|form| rich(Style { big_endian: true, wide: true, block: 64, ..Style::new(*form) }));
    plain.chain(packed).collect()
}

/// PLY.
pub fn ply() -> Vec<Vec<u8>> {
    let soup = bodies::unit_cube();
    let mut files = vec![ply_text(&soup), TRISTRIPS.as_bytes().to_vec()];
    files.extend([false, true].map(|big_endian| ply_binary(&soup, big_endian)));
    files
}

const TRISTRIPS: &str = "ply\nformat ascii 1.0\ncomment tag 1 a\nobj_info x\nelement tristrips 1\nproperty list int int \
    vertex_indices\nelement vertex 4\nproperty float32 x\nproperty float32 y\nproperty float32 z\nproperty list uchar float \
    weights\nelement other 1\nproperty char c\nend_header\n8 0 1 2 -1 3 2 1 0\n0 0 0 0\n1 0 0 1 0.5\n0 1 0 2 0.1 0.2\n0 0 1 0\n7\n";

fn ply_head(soup: &Soup, format: &str) -> String {
    let (vertices, faces) = (soup.vertices.len(), soup.triangles.len());
    format!(
        "ply\nformat {format} 1.0\nelement vertex {vertices}\nproperty double x\nproperty double y\nproperty double z\n\
         property uchar red\nelement face {faces}\nproperty list uchar int vertex_indices\nproperty int tag\nend_header\n"
    )
}

fn ply_text(soup: &Soup) -> Vec<u8> {
    let mut text = ply_head(soup, "ascii");
    soup.vertices.iter().for_each(|[x, y, z]| text += &format!("{x} {y} {z} 255\n"));
    soup.triangles.iter().for_each(|[a, b, c]| text += &format!("3 {a} {b} {c} 5\n"));
    text.into_bytes()
}

fn ply_binary(soup: &Soup, big_endian: bool) -> Vec<u8> {
    let mut out = ply_head(soup, if big_endian { "binary_big_endian" } else { "binary_little_endian" }).into_bytes();
    for p in &soup.vertices {
        p.iter().for_each(|c| out.extend(if big_endian { c.to_be_bytes() } else { c.to_le_bytes() }));
        out.push(200);
    }
    for t in &soup.triangles {
        out.push(3);
        t.iter().chain(&[5]).for_each(|v| out.extend(if big_endian { v.to_be_bytes() } else { v.to_le_bytes() }));
    }
    out
}

/// Legacy VTK.
pub fn vtk() -> Vec<Vec<u8>> {
    let soup = bodies::unit_cube();
    vec![vtk_text(&soup), vtk_binary(&soup, false), vtk_binary(&soup, true), VTK_5.as_bytes().to_vec()]
}

const VTK_5: &str = "# vtk DataFile Version 5.1\nx\nASCII\nDATASET POLYDATA\nFIELD FieldData 2\ntag_numbers 1 1 int\n5\n\
    tag_names 1 1 string\na\nPOINTS 4 float\n0 0 0 1 0 0 0 1 0 0 0 1\nMETADATA\nINFORMATION 0\n\nVERTICES 2 1\nOFFSETS \
    vtktypeint64\n0 1\nCONNECTIVITY vtktypeint64\n0\nTRIANGLE_STRIPS 2 6\nOFFSETS vtktypeint64\n0 6\nCONNECTIVITY \
    vtktypeint64\n0 1 2 3 0 1\nPOLYGONS 2 3\nOFFSETS vtktypeint64\n0 3\nCONNECTIVITY vtktypeint64\n0 2 1\n\
    CELL_DATA 3\nSCALARS tag int 1\nLOOKUP_TABLE default\n1 2 3\nPOINT_DATA 4\nVECTORS v float\n0 0 0 1 1 1 2 2 2 3 3 3\n\
    METADATA\nCOMPONENT_NAMES\nx\n\nz\nINFORMATION 2\nNAME L2_NORM_RANGE LOCATION vtkDataArray\nDATA 2 0.5 9.1\n\
    NAME NAMES LOCATION vtkAbstractArray\nDATA 2\na%20b\nc\n\nFIELD FieldData 1\nINFORMATION 1 4 double\n1 2 3 4\n";

fn vtk_text(soup: &Soup) -> Vec<u8> {
    let mut text = String::from("# vtk DataFile Version 3.0\ntitle\nASCII\nDATASET POLYDATA\n");
    text += &format!("POINTS {} double\n", soup.vertices.len());
    soup.vertices.iter().for_each(|[x, y, z]| text += &format!("{x} {y} {z}\n"));
    text += &format!("POLYGONS {} {}\n", soup.triangles.len(), 4 * soup.triangles.len());
    soup.triangles.iter().for_each(|[a, b, c]| text += &format!("3 {a} {b} {c}\n"));
    text += &format!("CELL_DATA {}\nFIELD FieldData 1\ntag 1 {} int\n", soup.triangles.len(), soup.triangles.len());
    soup.triangles.iter().for_each(|_| text += "4 ");
    text += &format!("\nPOINT_DATA {}\nSCALARS s float\nLOOKUP_TABLE default\n", soup.vertices.len());
    soup.vertices.iter().for_each(|_| text += "0.5 ");
    text.into_bytes()
}

fn vtk_binary(soup: &Soup, offsets: bool) -> Vec<u8> {
    let version = if offsets { "5.1" } else { "4.2" };
    let (vertices, faces) = (soup.vertices.len(), soup.triangles.len());
    let head = format!("# vtk DataFile Version {version}\ntitle\nBINARY\nDATASET POLYDATA\nPOINTS {vertices} float\n");
    let mut out = head.into_bytes();
    soup.vertices.iter().flatten().for_each(|c| out.extend((*c as f32).to_be_bytes()));
    if offsets {
        out.extend(format!("\nPOLYGONS {} {}\nOFFSETS vtktypeint64\n", faces + 1, 3 * faces).bytes());
        (0..=faces as i64).for_each(|f| out.extend((3 * f).to_be_bytes()));
        out.extend(b"\nCONNECTIVITY vtktypeint64\n");
        soup.triangles.iter().flatten().for_each(|v| out.extend(i64::from(*v).to_be_bytes()));
    } else {
        out.extend(format!("\nPOLYGONS {faces} {}\n", 4 * faces).bytes());
        soup.triangles.iter().for_each(|t| [3].iter().chain(t).for_each(|v| out.extend(v.to_be_bytes())));
    }
    out.extend(format!("\nCELL_DATA {faces}\nSCALARS tag int 1\nLOOKUP_TABLE default\n").bytes());
    (0..faces as i32).for_each(|f| out.extend(f.to_be_bytes()));
    out.extend(
        format!("\nMETADATA\nCOMPONENT_NAMES\nthe%20tag\n\nFIELD FieldData 2\nwords 1 {faces} string\n").bytes(),
    );
    (0..faces).for_each(|_| out.extend(b"\xc4name"));
    out.extend(format!("\nheat 1 {faces} unsigned_char\n").bytes());
    out.extend((0..faces).map(|f| f as u8));
    out.extend(b"\nMETADATA\nCOMPONENT_NAMES\n\nINFORMATION 1\nNAME UNITS_LABEL LOCATION vtkDataArray\nDATA K\n\n");
    out
}

/// Large files that ask for as much memory a byte as their format allows.
pub fn large() -> Vec<(&'static str, crate::Format, Vec<u8>)> {
    use crate::Format::{Obj, Ply, Stl, Vtk, Vtp};
    let triangles = 200_000;
    let soup = bodies::torus(2.0, 0.5, 400, 250);
    let groups: String =
        (0..triangles).fold("v 0 0 0\nv 1 0 0\nv 0 1 0\n".into(), |t, k| t + &format!("g {k}\nf 1 2 3\n"));
    let polygon: String = (0..20_000).fold("v 0 0 0\nv 1 0 0\nv 0 1 0\nf".into(), |t, k| t + [" 1", " 2", " 3"][k % 3]);
    let tags = "<VTKFile type=\"PolyData\">".to_owned() + &"<a b=\"\"/>".repeat(triangles);
    let pieces = "<VTKFile type=\"PolyData\"><PolyData>".to_owned() + &"<Piece/>".repeat(triangles);
    let arrays = "<VTKFile type=\"PolyData\"><PolyData><Piece><Points>".to_owned() + &"<Array/>".repeat(triangles);
    let attributes: String = (0..triangles).fold("<VTKFile".into(), |t, k| t + &format!(" a{k}=\"\""));
    vec![
        ("stl", Stl, stl_bytes::binary(&soup)),
        ("obj", Obj, obj_files::plain(&soup).into_bytes()),
        ("vertices", Obj, "v 0 0 0\n".repeat(triangles).into_bytes()),
        ("colours", Obj, ("v 1 1 1 1 1 1\n".to_owned() + &"v 0 0 0\n".repeat(triangles) + "f 1 2 3\n").into_bytes()),
        ("faces", Obj, ("v 0 0 0\nv 1 0 0\nv 0 1 0\n".to_owned() + &"f 1 2 3\n".repeat(triangles)).into_bytes()),
        ("groups", Obj, groups.into_bytes()),
        ("polygon", Obj, polygon.into_bytes()),
        ("tags", Vtp, tags.into_bytes()),
        ("pieces", Vtp, pieces.into_bytes()),
        ("arrays", Vtp, arrays.into_bytes()),
        ("attributes", Vtp, (attributes + ">").into_bytes()),
        ("ply", Ply, ply_binary(&soup, false)),
        ("ply text", Ply, ply_text(&soup)),
        ("vtk", Vtk, vtk_binary(&soup, false)),
        ("vtk 5", Vtk, vtk_binary(&soup, true)),
        ("vtp", Vtp, file(Style::new(Form::AppendedRaw), &[Piece::of(&soup)])),
        ("zlib", Vtp, file(Style { block: 32768, ..Style::new(Form::AppendedRaw) }, &[Piece::of(&soup)])),
        ("few points", Vtp, few_points(1 << 21)),
        (
            "ply strip",
            Ply,
            ply_of_bytes("tristrips", "uint", &[&400_000u32.to_le_bytes()[..], &[1, 2, 0, 3].repeat(100_000)]),
        ),
        (
            "ply polygon",
            Ply,
            ply_of_bytes("face", "uint", &[&400_000u32.to_le_bytes()[..], &[1, 2, 0, 3].repeat(100_000)]),
        ),
        ("ply copies", Ply, ply_of_bytes("face", "uchar", &[&[3, 0, 1, 2].repeat(400_000)[..]])),
        ("ply no corners", Ply, ply_of_bytes("face", "uchar", &[&[3, 0, 1, 2][..], &vec![0; 1 << 20]])),
        ("vtk strip", Vtk, vtk_of_bytes("TRIANGLE_STRIPS", 1, &[1, 2, 0, 3].repeat(100_000))),
        ("vtk polygon", Vtk, vtk_of_bytes("POLYGONS", 1, &[1, 2, 0, 3].repeat(100_000))),
        ("vtk copies", Vtk, vtk_of_bytes("POLYGONS", 400_000, &[1, 2, 0].repeat(400_000))),
        ("vtk text strip", Vtk, vtk_text_strip(1 << 18).into_bytes()),
        ("vtp strip", Vtp, vtp_of_bytes("Strips", 1, 400_000, 1)),
        ("vtp polygon", Vtp, vtp_of_bytes("Polys", 1, 400_000, 1)),
        ("vtp copies", Vtp, vtp_of_bytes("Polys", 400_000, 1_200_000, 1)),
        ("vtp shared", Vtp, vtp_of_bytes("Polys", 10_000, 30_000, 400)),
        ("obj copies", Obj, ("v 0 0 0\nv 1 0 0\nv 0 1 0\n".to_owned() + &"f 1 2 3\n".repeat(500_000)).into_bytes()),
    ]
}

/// Faces or strips over four points whose counts and indices are these bytes.
fn ply_of_bytes(element: &str, count: &str, parts: &[&[u8]]) -> Vec<u8> {
    let items = if count == "uint" { 1 } else { parts.concat().len() / 4 };
    let items = if parts.len() == 2 && count == "uchar" { parts[1].len() + 1 } else { items };
    let head = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty uchar x\nproperty uchar y\nproperty uchar z\n\
         element {element} {items}\nproperty list {count} uchar vertex_indices\nend_header\n"
    );
    [head.as_bytes(), &[0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1], &parts.concat()].concat()
}

/// So many cells over four points, with as many of these corners each.
fn vtk_of_bytes(cells: &str, count: usize, corners: &[u8]) -> Vec<u8> {
    let each = corners.len() / count;
    let (offsets, all) = (count + 1, corners.len());
    let head = "# vtk DataFile Version 5.1\nx\nBINARY\nDATASET POLYDATA\nPOINTS 4 unsigned_char\n\0\0\0\x01\0\0\0\x01\0\0\0\x01\n";
    let mut out = format!("{head}{cells} {offsets} {all}\nOFFSETS unsigned_int\n").into_bytes();
    (0..=count).for_each(|k| out.extend(((each * k) as u32).to_be_bytes()));
    out.extend(b"\nCONNECTIVITY unsigned_char\n");
    out.extend(corners);
    out
}

fn vtk_text_strip(count: usize) -> String {
    let head = "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0 1 0 0 0 1 0\n";
    format!("{head}TRIANGLE_STRIPS 1 {}\n{} {}", 3 * count + 1, 3 * count, "0 1 2 ".repeat(count))
}

/// Pieces that all have the same data: so many cells over four points, and corners of one byte.
fn vtp_of_bytes(section: &str, cells: usize, corners: usize, pieces: usize) -> Vec<u8> {
    let mut data = Vec::new();
    let ends = (1..=cells).flat_map(|k| ((corners / cells * k) as u32).to_le_bytes()).collect();
    let parts: [Vec<u8>; 3] = [vec![0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1], [1, 2, 0, 3].repeat(corners / 4), ends];
    let offsets = parts.map(|part| {
        let at = data.len();
        data.extend((part.len() as u32).to_le_bytes());
        data.extend(part);
        at
    });
    let array = |kind: &str, name: &str, at: usize| {
        let components = if name.is_empty() { 3 } else { 1 };
        format!(
            "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"appended\" offset=\"{at}\"/>"
        )
    };
    let piece = format!(
        "<Piece NumberOfPoints=\"4\" NumberOf{section}=\"{cells}\"><Points>{}</Points><{section}>{}{}</{section}></Piece>",
        array("UInt8", "", offsets[0]),
        array("UInt8", "connectivity", offsets[1]),
        array("UInt32", "offsets", offsets[2])
    );
    let head = "<VTKFile type=\"PolyData\"><PolyData>".to_owned() + &piece.repeat(pieces);
    [head.as_bytes(), b"</PolyData><AppendedData encoding=\"raw\">_", &data, b"</AppendedData></VTKFile>"].concat()
}

/// A text of polygons over a hundred points, with data.
fn few_points(count: usize) -> Vec<u8> {
    let polys =
        (0..count / 3).map(|k| vec![(k % 100) as u32, ((k + 1) % 100) as u32, ((k + 3) % 100) as u32]).collect();
    let points: Vec<[f64; 3]> = (0..100).map(|k| [f64::from(k), f64::from(k * k % 7), f64::from(k % 3)]).collect();
    let cell_data = vec![Array::new("a", "Int8", 1, &vec![1.0; count / 3])];
    file(Style::new(Form::Ascii), &[Piece { points, polys, cell_data, ..Piece::default() }])
}
