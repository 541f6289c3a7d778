//! Angles of vectors side by side: atan2 of several vectors at once costs little more than of one.

use super::Instruction;

/// How far apart two of them may be.
const WINDOW: usize = 96;

/// An order of instructions, with atan2s that do not need one another together, as far as no sine stands between them.
pub(super) fn gather(mut order: Vec<usize>, instructions: &[Instruction]) -> Vec<usize> {
    let is_atan2 = |place: usize| matches!(instructions[place], Instruction::Atan2(..));
    let mut late = vec![false; instructions.len()];
    let mut first = 0;
    while first < order.len() {
        if !is_atan2(order[first]) {
            first += 1;
            continue;
        }
        let window = order[first..].iter().take(WINDOW);
        let window: Vec<usize> =
            window.copied().take_while(|&place| !matches!(instructions[place], Instruction::SinCos(_))).collect();
        let (mut free, mut gathered, mut after) = (Vec::new(), Vec::new(), Vec::new());
        for &place in &window {
            let mut needs = false;
            instructions[place].for_each_operand(|operand| needs |= late[operand.index()]);
            let group = match needs {
                true => &mut after,
                false if is_atan2(place) => &mut gathered,
                false => &mut free,
            };
            group.push(place);
            late[place] = needs || is_atan2(place);
        }
        window.iter().for_each(|&place| late[place] = false);
        let next = first + if gathered.len() > 1 { free.len() + gathered.len() } else { 1 };
        if gathered.len() > 1 {
            let gathered = free.into_iter().chain(gathered).chain(after);
            order[first..first + window.len()].iter_mut().zip(gathered).for_each(|(place, new)| *place = new);
        }
        first = next;
    }
    order
}
