// SPDX-License-Identifier: MIT OR Apache-2.0
//! VTP files in every encoding, made here and not by embound's writer.

use super::Soup;
use miniz_oxide::deflate::compress_to_vec_zlib;
use std::fmt::Write;

/// Where the numbers of arrays are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    Ascii,
    Binary,
    AppendedRaw,
    AppendedBase64,
}

/// How a file holds its data.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Style {
    pub form: Form,
    pub big_endian: bool,
    /// Sizes of 64 bits.
    pub wide: bool,
    /// Bytes of a block that zlib compresses; 0: no compression.
    pub block: usize,
}

impl Style {
    /// Little-endian with sizes of 32 bits.
    pub const fn new(form: Form) -> Style {
        Style { form, big_endian: false, wide: false, block: 0 }
    }

    /// Every combination.
    pub fn all() -> Vec<Style> {
        let mut all = vec![Style::new(Form::Ascii)];
        for form in [Form::Binary, Form::AppendedRaw, Form::AppendedBase64] {
            for k in 0..12 {
                let (big_endian, wide, block) = (k % 2 == 1, k % 4 > 1, [0, 40, 32768][k / 4]);
                all.push(Style { form, big_endian, wide, block });
            }
        }
        all
    }

    fn word(self, x: u64) -> Vec<u8> {
        let mut bytes = if self.wide { x.to_le_bytes().to_vec() } else { (x as u32).to_le_bytes().to_vec() };
        if self.big_endian {
            bytes.reverse();
        }
        bytes
    }

    /// Sizes and data, each of which base64 encodes by itself.
    pub fn packed(self, data: &[u8]) -> [Vec<u8>; 2] {
        if self.block == 0 {
            return [[self.word(data.len() as u64), data.to_vec()].concat(), Vec::new()];
        }
        let blocks: Vec<Vec<u8>> = data.chunks(self.block).map(|b| compress_to_vec_zlib(b, 6)).collect();
        let mut sizes = vec![blocks.len(), self.block, data.len() % self.block];
        sizes.extend(blocks.iter().map(Vec::len));
        [sizes.iter().flat_map(|n| self.word(*n as u64)).collect(), blocks.concat()]
    }
}

/// An array: its name, VTK's name of its type, components and numbers.
#[derive(Clone, Debug)]
pub struct Array {
    pub name: &'static str,
    pub kind: &'static str,
    pub components: usize,
    pub values: Vec<f64>,
}

impl Array {
    pub fn new(name: &'static str, kind: &'static str, components: usize, values: &[f64]) -> Array {
        Array { name, kind, components, values: values.to_vec() }
    }

    fn bytes(&self, big_endian: bool) -> Vec<u8> {
        let one = |x: &f64| {
            let mut bytes = match self.kind {
                "Int8" => (*x as i8).to_le_bytes().to_vec(),
                "UInt8" => (*x as u8).to_le_bytes().to_vec(),
                "Int16" => (*x as i16).to_le_bytes().to_vec(),
                "UInt16" => (*x as u16).to_le_bytes().to_vec(),
                "Int32" => (*x as i32).to_le_bytes().to_vec(),
                "UInt32" => (*x as u32).to_le_bytes().to_vec(),
                "Int64" => (*x as i64).to_le_bytes().to_vec(),
                "UInt64" => (*x as u64).to_le_bytes().to_vec(),
                "Float32" => (*x as f32).to_le_bytes().to_vec(),
                _ => x.to_le_bytes().to_vec(),
            };
            if big_endian {
                bytes.reverse();
            }
            bytes
        };
        self.values.iter().flat_map(one).collect()
    }
}

/// What a piece holds.
#[derive(Clone, Debug, Default)]
pub struct Piece {
    pub points: Vec<[f64; 3]>,
    pub verts: Vec<Vec<u32>>,
    pub lines: Vec<Vec<u32>>,
    pub strips: Vec<Vec<u32>>,
    pub polys: Vec<Vec<u32>>,
    pub point_data: Vec<Array>,
    pub cell_data: Vec<Array>,
}

impl Piece {
    /// The triangles of a mesh.
    pub fn of(soup: &Soup) -> Piece {
        let polys = soup.triangles.iter().map(|t| t.to_vec()).collect();
        Piece { points: soup.vertices.clone(), polys, ..Piece::default() }
    }
}

/// A file being made.
pub struct Vtp {
    style: Style,
    pub text: String,
    appended: Vec<u8>,
}

impl Vtp {
    /// Up to the beginning of the data set.
    pub fn new(style: Style) -> Vtp {
        let order = if style.big_endian { "BigEndian" } else { "LittleEndian" };
        let header = if style.wide { "UInt64" } else { "UInt32" };
        let compressor = if style.block > 0 { " compressor=\"vtkZLibDataCompressor\"" } else { "" };
        let text = format!(
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"{order}\" \
             header_type=\"{header}\"{compressor}>\n  <PolyData>\n"
        );
        Vtp { style, text, appended: Vec::new() }
    }

    fn put(&mut self, text: std::fmt::Arguments) {
        self.text.write_fmt(text).expect("a string takes everything");
    }

    /// An array, with other attributes.
    pub fn array(&mut self, array: &Array, others: &str) {
        let Array { name, kind, components, .. } = array;
        let tag =
            format!("        <DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\"{others}");
        let numbers = array.values.iter().fold(String::new(), |text, x| text + &format!("{x:?} "));
        self.data(&tag, &array.bytes(self.style.big_endian), &numbers.replace(".0 ", " "));
        self.text.push_str("</DataArray>\n");
    }

    /// Strings, each with its zero.
    pub fn strings(&mut self, name: &str, strings: &[&str]) {
        let bytes: Vec<u8> = strings.iter().flat_map(|s| s.bytes().chain([0])).collect();
        let numbers = bytes.iter().fold(String::new(), |text, b| text + &format!("{b} "));
        let tag = format!("<Array type=\"String\" Name=\"{name}\" NumberOfTuples=\"{}\"", strings.len());
        self.data(&tag, &bytes, &numbers);
        self.text.push_str("</Array>\n");
    }

    fn data(&mut self, tag: &str, bytes: &[u8], numbers: &str) {
        let packed = self.style.packed(bytes);
        let encoded = packed.each_ref().map(|part| base64(part)).concat();
        let offset = self.appended.len();
        match self.style.form {
            Form::Ascii => self.put(format_args!("{tag} format=\"ascii\">\n          {numbers}\n")),
            Form::Binary => self.put(format_args!("{tag} format=\"binary\">\n          {encoded}\n")),
            Form::AppendedRaw => {
                self.put(format_args!("{tag} format=\"appended\" offset=\"{offset}\">"));
                self.appended.extend(packed.concat());
            }
            Form::AppendedBase64 => {
                self.put(format_args!("{tag} format=\"appended\" offset=\"{offset}\">"));
                self.appended.extend(encoded.bytes());
            }
        }
    }

    /// A piece.
    pub fn piece(&mut self, piece: &Piece) {
        let Piece { points, verts, lines, strips, polys, point_data, cell_data } = piece;
        self.put(format_args!(
            "    <Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\" NumberOfStrips=\"{}\" \
             NumberOfPolys=\"{}\">\n",
            points.len(),
            verts.len(),
            lines.len(),
            strips.len(),
            polys.len()
        ));
        for (name, arrays) in [("PointData", point_data), ("CellData", cell_data)] {
            self.put(format_args!("      <{name}>\n"));
            arrays.iter().for_each(|a| self.array(a, ""));
            self.put(format_args!("      </{name}>\n"));
        }
        self.put(format_args!("      <Points>\n"));
        self.array(&Array::new("Points", "Float64", 3, points.as_flattened()), "");
        self.put(format_args!("      </Points>\n"));
        for (name, cells) in [("Verts", verts), ("Lines", lines), ("Strips", strips), ("Polys", polys)] {
            self.put(format_args!("      <{name}>\n"));
            let corners: Vec<f64> = cells.iter().flatten().map(|v| f64::from(*v)).collect();
            let mut ends = Vec::new();
            cells.iter().for_each(|c| ends.push(ends.last().unwrap_or(&0.0) + c.len() as f64));
            self.array(&Array::new("connectivity", "Int64", 1, &corners), "");
            self.array(&Array::new("offsets", "Int32", 1, &ends), "");
            self.put(format_args!("      </{name}>\n"));
        }
        self.put(format_args!("    </Piece>\n"));
    }

    /// Tag numbers and their names.
    pub fn tag_names(&mut self, names: &[(i32, &str)]) {
        let numbers: Vec<f64> = names.iter().map(|(tag, _)| f64::from(*tag)).collect();
        let strings: Vec<&str> = names.iter().map(|(_, name)| *name).collect();
        self.text.push_str("    <FieldData>\n");
        self.array(&Array::new("tag_numbers", "Int32", 1, &numbers), &format!(" NumberOfTuples=\"{}\"", numbers.len()));
        self.strings("tag_names", &strings);
        self.text.push_str("    </FieldData>\n");
    }

    /// The file.
    pub fn finish(mut self) -> Vec<u8> {
        self.text.push_str("  </PolyData>\n");
        let encoding = match self.style.form {
            Form::AppendedRaw => "raw",
            Form::AppendedBase64 => "base64",
            _ => return (self.text + "</VTKFile>\n").into_bytes(),
        };
        self.put(format_args!("  <AppendedData encoding=\"{encoding}\">\n   _"));
        let mut out = self.text.into_bytes();
        out.extend(self.appended);
        out.extend(b"\n  </AppendedData>\n</VTKFile>\n");
        out
    }
}

/// A file of pieces.
pub fn file(style: Style, pieces: &[Piece]) -> Vec<u8> {
    let mut vtp = Vtp::new(style);
    pieces.iter().for_each(|piece| vtp.piece(piece));
    vtp.finish()
}

/// A file with all that embound reads: tags with names, data, strips and cells that are no faces.
pub fn rich(style: Style) -> Vec<u8> {
    let mut vtp = Vtp::new(style);
    vtp.tag_names(&[(3, "hot wall"), (7, "inlet")]);
    vtp.piece(&rich_piece());
    vtp.finish()
}

/// A cube: two sides are a strip, the others polygons.
pub fn rich_piece() -> Piece {
    let points = (0..8).map(|k| [f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2)]).collect();
    Piece {
        points,
        verts: vec![vec![0], vec![1, 2]],
        lines: vec![vec![0, 1, 3]],
        strips: vec![vec![0, 4, 2, 6, 3, 7]],
        polys: vec![vec![0, 2, 3, 1], vec![4, 5, 7, 6], vec![0, 1, 5, 4], vec![1, 3, 7, 5]],
        point_data: vec![
            Array::new("temperature", "Float32", 1, &[0.5, 1.5, 2.5, 3.5, 4.5, 5.5, 6.5, -7.5]),
            Array::new("wind", "Float64", 3, &std::array::from_fn::<f64, 24, _>(|k| 0.1 * k as f64)),
        ],
        cell_data: vec![
            Array::new("tag", "Int32", 1, &[9.0, 9.0, 9.0, 7.0, 3.0, 3.0, 7.0, 3.0]),
            Array::new("id", "UInt16", 1, &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 65535.0]),
        ],
    }
}

/// Base64 with padding.
pub fn base64(bytes: &[u8]) -> String {
    let letters = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut out = String::new();
    for part in bytes.chunks(3) {
        let word = part.iter().chain(&[0; 2]).take(3).fold(0u32, |word, b| word << 8 | u32::from(*b));
        for k in 0..4 {
            let letter = letters[(word >> (18 - 6 * k)) as usize & 63];
            out.push(if k <= part.len() { letter as char } else { '=' });
        }
    }
    out
}
