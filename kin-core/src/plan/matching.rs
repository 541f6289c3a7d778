//! Which row gives which unknown, and in which order: matching, and the blocks that must be solved together.
//!
//! A maximum matching of rows and unknowns (augmenting paths), then the strongly connected components of the graph in
//! which a row depends on the rows that are matched with its other unknowns (Tarjan 1972). They come in the order in
//! which they can be solved. The decomposition is that of Dulmage and Mendelsohn (1958); in a linkage its blocks are the
//! Assur groups.

/// Rows and unknowns of every block.
pub(super) type Blocks = Vec<(Vec<usize>, Vec<usize>)>;

/// Blocks of (rows, unknowns) in order of solution, for rows given by the unknowns (0 .. count) that they hold; or the
/// rows that no unknown is left for.
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

/// The unknown of every row, or the rows that get none.
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

/// Breadth first, so that a long chain cannot exhaust the stack.
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

/// Strongly connected components, those that others lead to first.
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
        while let Some(&mut (node, ref mut place)) = open.last_mut() {
            if *place == 0 {
                number[node] = next;
                low[node] = next;
                next += 1;
                stack.push(node);
                on_stack[node] = true;
            }
            if let Some(&child) = successors[node].get(*place) {
                *place += 1;
                if number[child] == NEW {
                    open.push((child, 0));
                } else if on_stack[child] {
                    low[node] = low[node].min(number[child]);
                }
                continue;
            }
            // A node without successors comes here at place 0 once; one with successors, at their end.
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
        // Row 0: a; rows 1, 2: b, c (and a); row 3: d (and b).
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
