//! The programs of the test mechanisms, compiled once for all tests.

use crate::every_mechanism;
use crate::mechanisms::*;
use kin_runtime::cli;
use std::ffi::OsString;
use std::process::ExitCode;

macro_rules! programs {
    (
        moving { $($moving:ident: $Moving:ident, $from:literal, $to:literal;)* }
        unassembled { $($other:ident: $Other:ident;)* }
    ) => {
        /// Runs the program of the test mechanism of this name; the first argument is the program's name.
        ///
        /// # Panics
        /// When there is no mechanism of this name.
        #[must_use]
        pub fn run(mechanism: &str, arguments: Vec<OsString>) -> ExitCode {
            match mechanism {
                $(stringify!($Moving) => cli::run_from::<$Moving>(arguments),)*
                $(stringify!($Other) => cli::run_from::<$Other>(arguments),)*
                _ => panic!("no test mechanism is called {mechanism}"),
            }
        }
    };
}

every_mechanism!(programs);
