//! Commands that this program was built without.

use super::failure::Failure;
use std::ffi::OsString;

/// Any arguments after the command; they are ignored.
#[derive(Debug, clap::Args)]
#[command(disable_help_flag = true)]
pub(super) struct MissingArgs {
    #[arg(trailing_var_arg = true, allow_hyphen_values = true, hide = true)]
    rest: Vec<OsString>,
}

/// The error that names the feature to which the command belongs.
pub(super) fn run(_: &MissingArgs, command: &str) -> Result<(), Failure> {
    Err(Failure::usage(format!(
        "this program was built without `{command}`, which needs the feature `{command}` of kin-runtime: write \
         `features = [\"cli\", \"{command}\"]` in Cargo.toml; the examples take it as `--features {command}`"
    )))
}
