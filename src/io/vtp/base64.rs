// SPDX-License-Identifier: MIT OR Apache-2.0
//! Base64 (RFC 4648) as VTK writes it: several encodings one behind the other, each padded, white space
//! anywhere.

use super::xml::wrong;
use crate::error::{Result, try_with_capacity};

/// Bytes from base64 text.
pub(super) struct Base64<'a> {
    text: &'a [u8],
    at: usize,
    /// Where the text is in the file.
    offset: usize,
    /// Bytes that were decoded with the last ones taken.
    left: ([u8; 3], usize),
}

const INVALID: u8 = 0xff;

const VALUES: [u8; 256] = {
    let letters = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut values = [INVALID; 256];
    let mut k = 0;
    while k < 64 {
        values[letters[k] as usize] = k as u8;
        k += 1;
    }
    values
};

impl<'a> Base64<'a> {
    /// From the beginning of a text that is at `offset` of the file.
    pub fn new(text: &'a [u8], offset: usize) -> Base64<'a> {
        Base64 { text, at: 0, offset, left: ([0; 3], 0) }
    }

    /// No more bytes are left than this.
    pub fn at_most(&self) -> usize {
        (self.text.len() - self.at) / 4 * 3 + self.left.1
    }

    /// Where the next text is in the file.
    pub fn offset(&self) -> usize {
        self.offset + self.at
    }

    /// The next bytes; there may be so many.
    pub fn take(&mut self, count: usize) -> Result<Vec<u8>> {
        let mut out = try_with_capacity("bytes", count)?;
        loop {
            let (bytes, n) = self.left;
            let used = n.min(count - out.len());
            out.extend_from_slice(&bytes[..used]);
            self.left = ([bytes[used.min(2)], bytes[(used + 1).min(2)], bytes[2]], n - used);
            if out.len() == count {
                return Ok(out);
            }
            self.left = self.group()?;
        }
    }

    /// One to three bytes from four letters.
    fn group(&mut self) -> Result<([u8; 3], usize)> {
        let mut letters = [0u8; 4];
        for slot in &mut letters {
            while self.text.get(self.at).is_some_and(u8::is_ascii_whitespace) {
                self.at += 1;
            }
            let Some(&letter) = self.text.get(self.at) else {
                return Err(wrong(self.offset(), "the base64 data end here"));
            };
            *slot = letter;
            self.at += 1;
        }
        let count = letters.iter().position(|b| *b == b'=').unwrap_or(4);
        let values = letters.map(|b| VALUES[b as usize]);
        let padded = letters[count..].iter().all(|b| *b == b'=');
        if count < 2 || !padded || values[..count].contains(&INVALID) {
            let shown = String::from_utf8_lossy(&letters).into_owned();
            return Err(wrong(self.offset(), format_args!("\"{shown}\" before this is not base64")));
        }
        let [a, b, c, d] = values;
        Ok(([(a << 2) | (b >> 4), (b << 4) | ((c & 63) >> 2), (c << 6) | (d & 63)], count - 1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(text: &str, count: usize) -> Result<Vec<u8>> {
        Base64::new(text.as_bytes(), 100).take(count)
    }

    #[test]
    fn the_vectors_of_rfc_4648_are_decoded() {
        let vectors = ["Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"];
        for (k, text) in vectors.into_iter().enumerate() {
            assert_eq!(all(text, k + 1).unwrap(), b"foobar"[..=k]);
            assert_eq!(
                all(text, k + 2).unwrap_err().message(),
                format!("offset {}: the base64 data end here", 100 + text.len())
            );
        }
        assert_eq!(all(" +/\n+ /\t", 3).unwrap(), [0xfb, 0xff, 0xbf]);
    }

    #[test]
    fn encodings_one_behind_the_other_are_one_stream_however_they_are_taken() {
        for step in 1..9 {
            let mut source = Base64::new(b"Zg==Zm8=Zm9vYg==", 0);
            let mut out = Vec::new();
            while out.len() < 7 {
                out.extend(source.take(step.min(7 - out.len())).unwrap());
            }
            assert_eq!(out, b"ffofoob");
        }
    }

    #[test]
    fn what_is_not_base64_is_refused_with_its_place() {
        for text in ["Z===", "====", "Zg=v", "Zm9_", "Zm9-", "Z\u{e9}==", "Z=g="] {
            let message = all(text, 3).unwrap_err().message().to_owned();
            assert!(message.starts_with("offset 104: \""), "{message}");
        }
        assert!(all("Zm9", 2).is_err());
    }
}
