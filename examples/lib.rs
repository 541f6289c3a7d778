//! One mechanism per file: `cargo run --release --example four_bar`.
