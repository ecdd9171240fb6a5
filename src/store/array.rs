// SPDX-License-Identifier: MIT OR Apache-2.0
//! An array that is owned, or lies in a block that others share. Which of the two makes no difference to those who read
//! it: it is a pointer and a length.

use super::block::Block;
use super::plain::Plain;
use crate::error::{Result, try_copy};
use std::fmt;
use std::ops::Deref;
use std::ptr::NonNull;
use std::slice;
use std::sync::Arc;

/// Elements that do not change while they are shared. A clone is O(1).
pub(crate) struct Array<T: Plain> {
    at: NonNull<T>,
    len: usize,
    owner: Owner<T>,
}

/// What keeps the elements where they are.
#[derive(Clone)]
enum Owner<T> {
    Own(Arc<Vec<T>>),
    Block { _block: Arc<Block> },
}

// SAFETY: shared, the elements are only read; they are changed through an exclusive borrow of their only owner.
unsafe impl<T: Plain> Send for Array<T> {}
// SAFETY: as above.
unsafe impl<T: Plain> Sync for Array<T> {}

impl<T: Plain> Array<T> {
    /// `len` elements from byte `offset` of a block on; none where they do not lie within it, in their place.
    pub(super) fn within(block: &Arc<Block>, offset: usize, len: usize) -> Option<Array<T>> {
        let size = len.checked_mul(size_of::<T>())?;
        let bytes = block.bytes().get(offset..offset.checked_add(size)?)?;
        let at = NonNull::from(bytes).cast::<T>();
        at.is_aligned().then(|| Array { at, len, owner: Owner::Block { _block: block.clone() } })
    }

    /// Whether both are the same elements in the same place.
    pub(crate) fn is(&self, other: &Array<T>) -> bool {
        self.at == other.at && self.len == other.len
    }

    /// The elements to be changed: a copy where they are shared.
    pub(crate) fn edit(&mut self, what: &str) -> Result<&mut [T]> {
        let alone = match &mut self.owner {
            Owner::Own(own) => Arc::get_mut(own).is_some(),
            Owner::Block { .. } => false,
        };
        if !alone {
            *self = try_copy(what, self)?.into();
        }
        // SAFETY: the only owner is borrowed exclusively.
        Ok(unsafe { slice::from_raw_parts_mut(self.at.as_ptr(), self.len) })
    }
}

impl<T: Plain> Deref for Array<T> {
    type Target = [T];

    #[inline(always)]
    fn deref(&self) -> &[T] {
        // SAFETY: the owner keeps so many elements there, and nobody changes them meanwhile; any bytes are elements.
        unsafe { slice::from_raw_parts(self.at.as_ptr(), self.len) }
    }
}

impl<T: Plain> From<Vec<T>> for Array<T> {
    fn from(mut own: Vec<T>) -> Array<T> {
        // Moving the vector leaves its elements where they are.
        let (at, len) = (own.as_mut_ptr(), own.len());
        Array { at: NonNull::new(at).unwrap_or(NonNull::dangling()), len, owner: Owner::Own(Arc::new(own)) }
    }
}

impl<T: Plain> Default for Array<T> {
    fn default() -> Array<T> {
        Vec::new().into()
    }
}

impl<T: Plain> Clone for Array<T> {
    fn clone(&self) -> Array<T> {
        Array { owner: self.owner.clone(), ..*self }
    }
}

impl<T: Plain + fmt::Debug> fmt::Debug for Array<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.iter()).finish()
    }
}

impl<'a, T: Plain> IntoIterator for &'a Array<T> {
    type Item = &'a T;
    type IntoIter = slice::Iter<'a, T>;

    fn into_iter(self) -> slice::Iter<'a, T> {
        self.iter()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_shared_is_copied_before_it_changes() {
        let mut a = Array::from(vec![1u32, 2, 3]);
        let place = a.as_ptr();
        a.edit("numbers").expect("memory")[0] = 7;
        assert_eq!(a.as_ptr(), place, "alone, it is changed in its place");
        let kept = a.clone();
        assert!(kept.is(&a));
        a.edit("numbers").expect("memory")[1] = 8;
        assert_eq!((&a[..], &kept[..]), (&[7, 8, 3][..], &[7, 2, 3][..]));
        assert!(Array::<u32>::default().is_empty());
    }

    #[test]
    fn a_view_keeps_its_block_and_lies_within_it() {
        let bytes: Vec<u8> = (0..128).collect();
        let block = Block::copy_of(&bytes).expect("memory");
        let mut view = Array::<u32>::within(&block, 64, 4).expect("a view");
        assert!(Array::<u32>::within(&block, 66, 4).is_none());
        assert!(Array::<u32>::within(&block, 64, 17).is_none());
        assert!(Array::<u32>::within(&block, usize::MAX, 1).is_none());
        assert!(Array::<u64>::within(&block, 0, usize::MAX).is_none());
        drop(block);
        assert_eq!(view[3], u32::from_ne_bytes([76, 77, 78, 79]));
        view.edit("numbers").expect("memory")[0] = 1;
        assert_eq!((view[0], view[3]), (1, u32::from_ne_bytes([76, 77, 78, 79])));
    }
}
