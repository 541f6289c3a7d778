//! Reading packed tables: names from one text, numbers from one string of bytes.

use crate::model::Frame;

/// A text and packed numbers, with how much of them is read.
#[derive(Clone, Copy, Debug)]
pub struct Rest<'w> {
    text: &'static str,
    bytes: &'w [u8],
    /// The index of the next byte. The compiler evaluates an increment faster than a shortened slice.
    at: usize,
}

impl<'w> Rest<'w> {
    pub(super) const fn new(text: &'static str, bytes: &'w [u8]) -> Self {
        Self { text, bytes, at: 0 }
    }

    pub(super) const fn word(&mut self) -> usize {
        let (mut word, mut shift) = (0, 0);
        loop {
            let byte = self.bytes[self.at] as usize;
            self.at += 1;
            word |= (byte & 127) << shift;
            if byte < 128 {
                return word;
            }
            shift += 7;
        }
    }

    pub(super) const fn name(&mut self) -> &'static str {
        let (name, rest) = self.text.split_at(self.word());
        self.text = rest;
        name
    }

    /// 0 stands for none.
    pub(super) const fn index_if_any(&mut self) -> Option<usize> {
        match self.word() {
            0 => None,
            k => Some(k - 1),
        }
    }

    /// 0 stands for none, 1 for ground.
    pub(super) const fn frame(&mut self) -> Option<Frame> {
        match self.word() {
            0 => None,
            1 => Some(Frame::Ground),
            k => Some(Frame::Body(k - 2)),
        }
    }
}
