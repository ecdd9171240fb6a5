// SPDX-License-Identifier: MIT OR Apache-2.0
//! The types of numbers that files hold, with the names that VTK's XML has for them, and their bytes.

use crate::error::{Result, try_with_capacity};
use crate::mesh::FieldType;

/// A type of numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Number {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    I64,
    U64,
    F32,
    F64,
}

/// Their names.
const NAMES: [(&str, Number); 10] = [
    ("Int8", Number::I8),
    ("UInt8", Number::U8),
    ("Int16", Number::I16),
    ("UInt16", Number::U16),
    ("Int32", Number::I32),
    ("UInt32", Number::U32),
    ("Int64", Number::I64),
    ("UInt64", Number::U64),
    ("Float32", Number::F32),
    ("Float64", Number::F64),
];

impl Number {
    pub fn named(name: &str) -> Option<Number> {
        NAMES.iter().find(|(n, _)| *n == name).map(|(_, number)| *number)
    }

    pub fn name(self) -> &'static str {
        NAMES.iter().find(|(_, number)| *number == self).map_or("", |(n, _)| n)
    }

    /// Bytes of one.
    pub fn size(self) -> usize {
        match self {
            Number::I8 | Number::U8 => 1,
            Number::I16 | Number::U16 => 2,
            Number::I32 | Number::U32 | Number::F32 => 4,
            Number::I64 | Number::U64 | Number::F64 => 8,
        }
    }

    /// The number that a word is, rounded as the bytes of this type would be; none where the type has no such number.
    pub fn parsed(self, word: &[u8]) -> Option<f64> {
        let text = std::str::from_utf8(word).ok()?;
        let x = if self == Number::F32 { f64::from(text.parse::<f32>().ok()?) } else { text.parse().ok()? };
        let fits = match self {
            // A number too large becomes infinite, and is not the infinity that is spelt.
            Number::F32 | Number::F64 => !x.is_infinite() || text.contains(['i', 'I']),
            Number::I8 => f64::from(x as i8) == x,
            Number::U8 => f64::from(x as u8) == x,
            Number::I16 => f64::from(x as i16) == x,
            Number::U16 => f64::from(x as u16) == x,
            Number::I32 => f64::from(x as i32) == x,
            Number::U32 => f64::from(x as u32) == x,
            Number::I64 => (x as i64) as f64 == x,
            Number::U64 => (x as u64) as f64 == x,
        };
        fits.then_some(x)
    }

    /// Whether it has whole numbers alone.
    pub fn is_integer(self) -> bool {
        !matches!(self, Number::F32 | Number::F64)
    }

    /// The numbers that bytes are; what is left over at the end is none.
    pub fn decode(self, bytes: &[u8], big_endian: bool) -> Result<Vec<f64>> {
        let mut values = try_with_capacity("values", bytes.len() / self.size())?;
        macro_rules! each {
            ($T:ty) => {
                for part in bytes.as_chunks().0 {
                    let x = if big_endian { <$T>::from_be_bytes(*part) } else { <$T>::from_le_bytes(*part) };
                    values.push(x as f64);
                }
            };
        }
        match self {
            Number::I8 => each!(i8),
            Number::U8 => each!(u8),
            Number::I16 => each!(i16),
            Number::U16 => each!(u16),
            Number::I32 => each!(i32),
            Number::U32 => each!(u32),
            Number::I64 => each!(i64),
            Number::U64 => each!(u64),
            Number::F32 => each!(f32),
            Number::F64 => each!(f64),
        }
        Ok(values)
    }

    /// Adds the bytes of a number, little-endian. What an integer type cannot hold becomes its nearest value.
    pub fn encode(self, x: f64, out: &mut Vec<u8>) {
        match self {
            Number::I8 => out.extend((x as i8).to_le_bytes()),
            Number::U8 => out.extend((x as u8).to_le_bytes()),
            Number::I16 => out.extend((x as i16).to_le_bytes()),
            Number::U16 => out.extend((x as u16).to_le_bytes()),
            Number::I32 => out.extend((x as i32).to_le_bytes()),
            Number::U32 => out.extend((x as u32).to_le_bytes()),
            Number::I64 => out.extend((x as i64).to_le_bytes()),
            Number::U64 => out.extend((x as u64).to_le_bytes()),
            Number::F32 => out.extend((x as f32).to_le_bytes()),
            Number::F64 => out.extend(x.to_le_bytes()),
        }
    }

    /// The type of a field with these values. There is no unsigned type of 64 bits: values that the signed one
    /// does not hold make it f64.
    pub fn field_type(self, values: &[f64]) -> FieldType {
        match self {
            Number::I8 => FieldType::I8,
            Number::U8 => FieldType::U8,
            Number::I16 => FieldType::I16,
            Number::U16 => FieldType::U16,
            Number::I32 => FieldType::I32,
            Number::U32 => FieldType::U32,
            Number::U64 if values.iter().any(|x| *x >= i64::MAX as f64) => FieldType::F64,
            Number::I64 | Number::U64 => FieldType::I64,
            Number::F32 => FieldType::F32,
            Number::F64 => FieldType::F64,
        }
    }

    /// The type that the values of a field are written in.
    pub fn of_field(kind: FieldType) -> Number {
        match kind {
            FieldType::I8 => Number::I8,
            FieldType::U8 => Number::U8,
            FieldType::I16 => Number::I16,
            FieldType::U16 => Number::U16,
            FieldType::I32 => Number::I32,
            FieldType::U32 => Number::U32,
            FieldType::I64 => Number::I64,
            FieldType::F32 => Number::F32,
            FieldType::F64 => Number::F64,
        }
    }
}
