//! One mechanism per file: `cargo run --example four_bar`.
