//! Finds cycles in graphs of dependencies: defines that use themselves, bodies that carry themselves.

/// The result of [`order`].
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Order {
    /// All nodes; each comes after the nodes that it leads to, unless they form a cycle.
    pub order: Vec<usize>,
    /// Cycles without common nodes, each starting at its smallest node.
    pub cycles: Vec<Vec<usize>>,
}

/// Orders the nodes of a graph topologically, where node `k` leads to `edges[k]`.
pub fn order(edges: &[Vec<usize>]) -> Order {
    #[derive(Clone, Copy, PartialEq)]
    enum State {
        New,
        Open,
        Done,
    }
    let mut state = vec![State::New; edges.len()];
    let mut on_cycle = vec![false; edges.len()];
    let mut result = Order::default();
    for root in 0..edges.len() {
        // The path from the root, each node with the number of its edges that have been followed. An explicit stack is
        // used because recursion on long chains could overflow the call stack.
        let mut path: Vec<(usize, usize)> = Vec::new();
        if state[root] == State::New {
            state[root] = State::Open;
            path.push((root, 0));
        }
        while let Some((node, followed)) = path.last_mut() {
            let Some(&next) = edges[*node].get(*followed) else {
                state[*node] = State::Done;
                result.order.push(*node);
                path.pop();
                continue;
            };
            *followed += 1;
            match state.get(next) {
                Some(State::New) => {
                    state[next] = State::Open;
                    path.push((next, 0));
                }
                Some(State::Open) => {
                    let start = path.iter().position(|(node, _)| *node == next).unwrap_or(0);
                    let circle: Vec<usize> = path[start..].iter().map(|(node, _)| *node).collect();
                    // Of several cycles that share a node, one is enough to explain the error.
                    if !circle.iter().any(|&node| on_cycle[node]) {
                        circle.iter().for_each(|&node| on_cycle[node] = true);
                        result.cycles.push(from_smallest(circle));
                    }
                }
                Some(State::Done) | None => {}
            }
        }
    }
    result
}

fn from_smallest(mut circle: Vec<usize>) -> Vec<usize> {
    let start = (0..circle.len()).min_by_key(|&k| circle[k]).unwrap_or(0);
    circle.rotate_left(start);
    circle
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chains_are_ordered_from_their_ends() {
        let found = order(&[vec![1, 2], vec![2], vec![]]);
        assert_eq!(found.order, [2, 1, 0]);
        assert!(found.cycles.is_empty());
    }

    #[test]
    fn circles_are_named_once() {
        assert_eq!(order(&[vec![0]]).cycles, [vec![0]]);
        assert_eq!(order(&[vec![1], vec![2], vec![1]]).cycles, [vec![1, 2]]);
        assert_eq!(order(&[vec![1, 2], vec![0, 2], vec![0, 1]]).cycles.len(), 1);
    }

    #[test]
    fn long_chains_need_no_stack() {
        let n = 100_000;
        let edges: Vec<Vec<usize>> = (0..n).map(|k| if k + 1 < n { vec![k + 1] } else { vec![] }).collect();
        assert_eq!(order(&edges).order.len(), n);
    }
}
