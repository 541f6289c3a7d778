//! Random changes of token trees.

use super::Dice;
use super::corpus::Corpus;
use proc_macro2::{Delimiter, Group, Ident, Punct, Spacing, Span, TokenStream, TokenTree};

/// A token tree that can be changed in place.
#[derive(Clone)]
pub(super) enum Tree {
    Leaf(TokenTree),
    Group(Delimiter, Vec<Tree>),
}

/// The token trees of a text.
pub(super) fn trees(source: &str) -> Vec<Tree> {
    fn read(stream: TokenStream) -> Vec<Tree> {
        (stream.into_iter())
            .map(|tree| match tree {
                TokenTree::Group(group) => Tree::Group(group.delimiter(), read(group.stream())),
                leaf => Tree::Leaf(leaf),
            })
            .collect()
    }
    read(source.parse().unwrap_or_else(|error| panic!("{error}: {source}")))
}

/// The token stream of token trees.
pub(super) fn stream(trees: Vec<Tree>) -> TokenStream {
    (trees.into_iter())
        .map(|tree| match tree {
            Tree::Leaf(leaf) => leaf,
            Tree::Group(delimiter, inner) => Group::new(delimiter, stream(inner)).into(),
        })
        .collect()
}

fn count(trees: &[Tree]) -> usize {
    trees.iter().map(|tree| 1 + if let Tree::Group(_, inner) = tree { count(inner) } else { 0 }).sum()
}

/// The list that contains the tree with this number, where trees are counted through all groups, and its index in that
/// list.
fn place(trees: &mut Vec<Tree>, mut number: usize) -> Option<(&mut Vec<Tree>, usize)> {
    for k in 0..trees.len() {
        if number == 0 {
            return Some((trees, k));
        }
        number -= 1;
        if let Tree::Group(_, inner) = &trees[k] {
            let inside = count(inner);
            if number < inside {
                let Tree::Group(_, inner) = &mut trees[k] else { return None };
                return place(inner, number);
            }
            number -= inside;
        }
    }
    None
}

const DELIMITERS: [Delimiter; 4] = [Delimiter::Parenthesis, Delimiter::Bracket, Delimiter::Brace, Delimiter::None];

/// Changes one token of `trees`, or its surroundings.
pub(super) fn damage(trees: &mut Vec<Tree>, dice: &mut Dice, corpus: &Corpus) {
    let total = count(trees);
    let other = match dice.below(3) {
        0 => corpus.any(dice),
        1 => dice.of_these(&corpus.words).clone(),
        _ => match place(trees, dice.below(total)) {
            Some((list, k)) => list[k].clone(),
            None => corpus.any(dice),
        },
    };
    let Some((list, k)) = place(trees, dice.below(total)) else {
        trees.push(other);
        return;
    };
    match dice.below(18) {
        0 => drop(list.remove(k)),
        1 => list.insert(k, list[k].clone()),
        2 => {
            let with = dice.below(list.len());
            list.swap(k, with);
        }
        3 | 4 => list[k] = other,
        5 => list.insert(k, other),
        6 => list.truncate(k),
        7 => {
            let end = (k + 1 + dice.below(6)).min(list.len());
            list.drain(k..end);
        }
        8 => {
            let end = (k + 1 + dice.below(6)).min(list.len());
            let again: Vec<Tree> = list[k..end].to_vec();
            let times = if dice.below(8) == 0 { 60 } else { 1 };
            for _ in 0..times {
                list.splice(k..k, again.iter().cloned());
            }
        }
        9 => {
            let inner = std::mem::replace(&mut list[k], other);
            list[k] = Tree::Group(*dice.of_these(&DELIMITERS), vec![inner]);
        }
        10 => {
            let end = (k + 1 + dice.below(6)).min(list.len());
            let inner = list.drain(k..end).collect();
            list.insert(k, Tree::Group(*dice.of_these(&DELIMITERS), inner));
        }
        11 => {
            let delimiter = *dice.of_these(&DELIMITERS);
            for _ in 0..dice.below(80) {
                let inner = std::mem::replace(&mut list[k], Tree::Group(delimiter, Vec::new()));
                list[k] = Tree::Group(delimiter, vec![inner]);
            }
        }
        12 => {
            if let Tree::Group(_, inner) = &list[k] {
                let inner = inner.clone();
                list.splice(k..=k, inner);
            }
        }
        13 => {
            if let Tree::Group(_, inner) = &list[k] {
                list[k] = Tree::Group(*dice.of_these(&DELIMITERS), inner.clone());
            }
        }
        14 | 15 => number(list, k, dice, corpus),
        16 => rewrite(&mut list[k], dice),
        _ => {
            let word = dice.of_these(&corpus.words).clone();
            list[k] = word;
        }
    }
}

/// Replaces the next number of a list, or the token itself where there is no number.
fn number(list: &mut [Tree], k: usize, dice: &mut Dice, corpus: &Corpus) {
    let is_number = |tree: &Tree| matches!(tree, Tree::Leaf(TokenTree::Literal(_)));
    let k = list[k..].iter().position(is_number).map_or(k, |next| k + next);
    list[k] = dice.of_these(&corpus.numbers).clone();
}

/// Changes the spelling of a word, or the spacing of a punctuation character.
fn rewrite(tree: &mut Tree, dice: &mut Dice) {
    match tree {
        Tree::Leaf(TokenTree::Ident(ident)) => {
            let mut text = ident.to_string();
            match dice.below(4) {
                0 => text.push('s'),
                1 => drop(text.pop()),
                2 => text = text.trim_start_matches("r#").chars().rev().collect(),
                _ if !matches!(text.as_str(), "self" | "Self" | "super" | "crate" | "_") => {
                    let raw = Ident::new_raw(text.trim_start_matches("r#"), Span::call_site());
                    *tree = Tree::Leaf(raw.into());
                    return;
                }
                _ => {}
            }
            if let Ok(ident) = syn::parse_str::<TokenTree>(&text) {
                *tree = Tree::Leaf(ident);
            }
        }
        Tree::Leaf(TokenTree::Punct(punct)) => {
            let spacing = if punct.spacing() == Spacing::Alone { Spacing::Joint } else { Spacing::Alone };
            *tree = Tree::Leaf(Punct::new(punct.as_char(), spacing).into());
        }
        _ => {}
    }
}
