//! Determines which row gives which unknown and in which order: maximum matching and strongly connected components.
//!
//! Augmenting paths give a maximum matching of rows and unknowns. A row then depends on the rows that are matched with
//! its other unknowns; the strongly connected components of this graph (Tarjan 1972) are the blocks of rows that must
//! be solved together, listed in an order in which they can be solved. This is the decomposition of Dulmage and
//! Mendelsohn (1958); in a linkage its blocks are the Assur groups.

/// The rows and the unknowns of every block.
pub(super) type Blocks = Vec<(Vec<usize>, Vec<usize>)>;

/// The blocks (rows, unknowns) in order of solution. `rows` lists for each row the unknowns (0 .. `count`) that it
/// contains. Fails with the rows that cannot be matched with an unknown.
pub(super) fn blocks(rows: &[Vec<usize>], count: usize) -> Result<Blocks, Vec<usize>> {
    let matched = matching(rows, count)?;
    let mut row_of = vec![usize::MAX; count];
    matched.iter().enumerate().for_each(|(row, &unknown)| row_of[unknown] = row);
    let successors: Vec<Vec<usize>> = rows
        .iter()
        .enumerate()
        .map(|(row, unknowns)| unknowns.iter().map(|&k| row_of[k]).filter(|&r| r != row && r != usize::MAX).collect())
        .collect();
    let components = components(&successors);
    let with_unknowns = components.into_iter().map(|mut rows| {
        rows.sort_unstable();
        let mut unknowns: Vec<usize> = rows.iter().map(|&row| matched[row]).collect();
        unknowns.sort_unstable();
        (rows, unknowns)
    });
    Ok(with_unknowns.collect())
}

/// The unknown matched with every row, or the rows that cannot be matched.
fn matching(rows: &[Vec<usize>], count: usize) -> Result<Vec<usize>, Vec<usize>> {
    let mut row_of: Vec<Option<usize>> = vec![None; count];
    let mut failed = Vec::new();
    for row in 0..rows.len() {
        if !augment(rows, &mut row_of, row) {
            failed.push(row);
        }
    }
    if !failed.is_empty() {
        return Err(failed);
    }
    let mut matched = vec![usize::MAX; rows.len()];
    for (unknown, row) in row_of.iter().enumerate() {
        if let Some(row) = row {
            matched[*row] = unknown;
        }
    }
    Ok(matched)
}

/// Searches an augmenting path from row `start` and applies it to the matching. The search is breadth-first and not
/// recursive, so that a long chain cannot overflow the stack.
fn augment(rows: &[Vec<usize>], row_of: &mut [Option<usize>], start: usize) -> bool {
    let mut came_from: Vec<Option<usize>> = vec![None; row_of.len()];
    let mut queue = std::collections::VecDeque::from([start]);
    while let Some(row) = queue.pop_front() {
        for &unknown in &rows[row] {
            if came_from[unknown].is_some() {
                continue;
            }
            came_from[unknown] = Some(row);
            match row_of[unknown] {
                Some(next) => queue.push_back(next),
                None => {
                    let mut free = unknown;
                    while let Some(row) = came_from[free] {
                        let before = row_of.iter().position(|&r| r == Some(row));
                        row_of[free] = Some(row);
                        match before {
                            Some(before) if row != start => free = before,
                            _ => break,
                        }
                    }
                    return true;
                }
            }
        }
    }
    false
}

/// Strongly connected components; each comes after the components that can be reached from it.
fn components(successors: &[Vec<usize>]) -> Vec<Vec<usize>> {
    const NEW: usize = usize::MAX;
    let n = successors.len();
    let (mut number, mut low, mut on_stack) = (vec![NEW; n], vec![0; n], vec![false; n]);
    let (mut stack, mut out, mut next) = (Vec::new(), Vec::new(), 0);
    for root in 0..n {
        if number[root] != NEW {
            continue;
        }
        let mut open = vec![(root, 0_usize)];
        while let Some(&mut (node, ref mut index)) = open.last_mut() {
            if *index == 0 {
                number[node] = next;
                low[node] = next;
                next += 1;
                stack.push(node);
                on_stack[node] = true;
            }
            if let Some(&child) = successors[node].get(*index) {
                *index += 1;
                if number[child] == NEW {
                    open.push((child, 0));
                } else if on_stack[child] {
                    low[node] = low[node].min(number[child]);
                }
                continue;
            }
            // All successors of the node have been visited.
            open.pop();
            if let Some(&(parent, _)) = open.last() {
                low[parent] = low[parent].min(low[node]);
            }
            if low[node] == number[node] {
                let mut component = Vec::new();
                while let Some(member) = stack.pop() {
                    on_stack[member] = false;
                    component.push(member);
                    if member == node {
                        break;
                    }
                }
                out.push(component);
            }
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_come_in_order_of_solution() {
        // Unknowns a, b, c, d are 0 to 3. Row 0 contains b, c, a; row 1 a; row 2 d, b; row 3 c, b.
        let rows = [vec![1, 2, 0], vec![0], vec![3, 1], vec![2, 1]];
        let blocks = blocks(&rows, 4).unwrap();
        assert_eq!(blocks, [(vec![1], vec![0]), (vec![0, 3], vec![1, 2]), (vec![2], vec![3])]);
    }

    #[test]
    fn a_row_too_many_is_named() {
        assert_eq!(blocks(&[vec![0], vec![0]], 2), Err(vec![1]));
    }

    #[test]
    fn augmenting_paths_change_earlier_choices() {
        let rows = [vec![0, 1], vec![0], vec![1, 2]];
        let order = blocks(&rows, 3).unwrap();
        assert_eq!(order, [(vec![1], vec![0]), (vec![0], vec![1]), (vec![2], vec![2])]);
    }
}
