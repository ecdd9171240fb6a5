// SPDX-License-Identifier: MIT OR Apache-2.0
//! Tags of faces from the groups, objects and materials of an OBJ file.
//!
//! Each combination that faces use is a tag, numbered from 0 in order of first use. A comment
//! `# tag <number> <name>` before a `g` gives the group this tag instead, whatever the material.

use crate::error::{Error, Result};
use crate::io::text::one_line;
use std::collections::BTreeMap;

/// Between group and material in a key: no name has it.
const BETWEEN: char = '\0';

/// The state of a file's statements, and the tags so far.
#[derive(Default)]
pub(super) struct Tags {
    /// Group or object, the separator, and the material.
    combination: String,
    object: String,
    group: String,
    material: String,
    /// The tag of the current group, where a comment gave it.
    numbered: Option<i32>,
    /// What the comment before a statement says.
    announced: Option<(i32, String)>,
    names: BTreeMap<i32, String>,
    /// The kind of faces in each combination.
    combinations: BTreeMap<String, u32>,
    /// The number of each kind of faces, where a comment gave it.
    kinds: Vec<Option<i32>>,
    /// The kinds of faces with a number.
    numbers: BTreeMap<i32, u32>,
    /// The kind of the next face, where nothing changed since the last.
    current: Option<u32>,
    kind_of_face: Vec<u32>,
}

impl Tags {
    /// A group begins; without a name it is none.
    pub fn group(&mut self, name: String) {
        self.numbered = self.announced.take().map(|(number, name)| {
            self.names.entry(number).or_insert(name);
            number
        });
        self.group = one_line(&name);
        self.current = None;
    }

    /// An object begins, outside all groups.
    pub fn object(&mut self, name: String) {
        self.object = one_line(&name);
        self.group.clear();
        self.numbered = None;
        self.current = None;
    }

    /// Another material.
    pub fn material(&mut self, name: String) {
        self.material = one_line(&name);
        self.current = None;
    }

    /// A comment, without its sign.
    pub fn comment(&mut self, text: &str) {
        let mut words = text.splitn(3, char::is_whitespace);
        if words.next() == Some("tag")
            && let Some(number) = words.next().and_then(|n| n.parse().ok())
        {
            self.announced = Some((number, one_line(words.next().unwrap_or(""))));
        }
    }

    /// Forgets a comment that was not before a group.
    pub fn end_of_statement(&mut self) {
        self.announced = None;
    }

    /// The next face.
    pub fn face(&mut self) -> Result<()> {
        let kind = match self.current {
            Some(kind) => kind,
            None => self.kind()?,
        };
        self.current = Some(kind);
        self.kind_of_face.try_reserve(1).map_err(|_| Error::memory("tags", self.kind_of_face.len() + 1))?;
        self.kind_of_face.push(kind);
        Ok(())
    }

    fn kind(&mut self) -> Result<u32> {
        // There are no more kinds than faces.
        let next = self.kinds.len() as u32;
        let kind = if let Some(number) = self.numbered {
            *self.numbers.entry(number).or_insert(next)
        } else {
            let first = if self.group.is_empty() { &self.object } else { &self.group };
            self.combination.clear();
            self.combination.extend([first, "\0", &self.material]);
            match self.combinations.get(&self.combination) {
                Some(&kind) => kind,
                None => {
                    self.combinations.insert(self.combination.clone(), next);
                    next
                }
            }
        };
        if kind == next {
            self.kinds.try_reserve(1).map_err(|_| Error::memory("tags", self.kinds.len() + 1))?;
            self.kinds.push(self.numbered);
        }
        Ok(kind)
    }

    /// The tag of each face, none at all where every one is 0, and the names of tags.
    #[allow(clippy::type_complexity)]
    pub fn finish(self) -> Result<(Vec<i32>, Vec<(i32, String)>)> {
        let Tags { mut names, combinations, kinds, numbers, kind_of_face, .. } = self;
        let mut free = (0..).filter(|n| !numbers.contains_key(n) && !names.contains_key(n));
        // There are fewer tags than i32 has numbers: a face has at least three corners.
        let tags: Vec<i32> = kinds.iter().map(|number| number.or_else(|| free.next()).unwrap_or(0)).collect();
        drop(free);
        for (combination, kind) in combinations {
            let name = match combination.split_once(BETWEEN) {
                Some((first, "")) => first.to_owned(),
                Some(("", material)) => material.to_owned(),
                _ => combination.replace(BETWEEN, ":"),
            };
            names.insert(tags[kind as usize], name);
        }
        names.retain(|_, name| !name.is_empty());
        let tag_of_face = match tags.iter().all(|tag| *tag == 0) {
            true => Vec::new(),
            false => kind_of_face.iter().map(|kind| tags[*kind as usize]).collect(),
        };
        Ok((tag_of_face, names.into_iter().collect()))
    }
}
