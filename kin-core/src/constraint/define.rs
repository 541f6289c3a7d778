//! Named expressions (defines): each is built once, after the defines that it uses.

use super::assembly::Assembly;
use crate::error::Origin;
use crate::expr::ExprId;
use crate::mechanism::{Define, Member, Range, defines_in};
use std::collections::HashSet;

/// A define, by its family and its index in the family.
type Named = (usize, i64);

impl Assembly<'_> {
    /// The value of a define, which is built only once however often it is used.
    pub(crate) fn define(&mut self, member: &Member) -> ExprId {
        let Some(define) = self.mechanism.defines.get(member.family) else { return self.graph.zero() };
        match index_in(define, member, self.index) {
            Some(index) => self.define_at(member.family, index, member.origin),
            None => {
                let range = define.range.map_or(0..1, Range::indices);
                self.error(member.origin, format!("the index is out of range: `{}` has {range:?}", define.name))
            }
        }
    }

    /// The value of a member of a family of defines.
    pub(crate) fn define_at(&mut self, family: usize, index: i64, origin: Origin) -> ExprId {
        if !self.defines.contains_key(&(family, index)) {
            self.build_with_uses((family, index));
        }
        match self.defines.get(&(family, index)) {
            Some(Some(value)) => *value,
            _ => {
                let name = &self.mechanism.defines[family].name;
                self.error(origin, format!("`{name}` is defined by itself"))
            }
        }
    }

    /// Builds a define after the defines that it uses. The search is iterative, so that a long chain cannot overflow
    /// the stack.
    fn build_with_uses(&mut self, named: Named) {
        let mut visited = HashSet::from([named]);
        let mut open = vec![(named, self.uses(named))];
        while let Some((_, uses)) = open.last_mut() {
            match uses.pop() {
                Some(next) => {
                    if visited.insert(next) && !self.defines.contains_key(&next) {
                        open.push((next, self.uses(next)));
                    }
                }
                None => {
                    if let Some((named, _)) = open.pop()
                        && !self.defines.contains_key(&named)
                    {
                        self.build(named);
                    }
                }
            }
        }
    }

    /// The defines that a define uses directly. An index out of range is reported when the define is built.
    fn uses(&self, (family, index): Named) -> Vec<Named> {
        let all = &self.mechanism.defines;
        let used = |member: &Member| {
            let define = all.get(member.family)?;
            Some((member.family, index_in(define, member, index)?))
        };
        defines_in(&all[family].formula).filter_map(used).collect()
    }

    fn build(&mut self, (family, index): Named) {
        self.defines.insert((family, index), None);
        let outer = std::mem::replace(&mut self.index, index);
        let value = self.formula(&self.mechanism.defines[family].formula);
        self.index = outer;
        self.defines.insert((family, index), Some(value));
    }
}

/// The index that `member` refers to when the index variable is `i`, if the family has such a member.
fn index_in(define: &Define, member: &Member, i: i64) -> Option<i64> {
    let range = define.range.map_or(0..1, Range::indices);
    member.index.at(i).map(|index| index as i64).filter(|index| range.contains(index))
}
