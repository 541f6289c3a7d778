//! The examples, read as modules, and their programs.

use kin_runtime::cli;
use std::process::ExitCode;

/// Calls a macro with the file and the mechanism of every example.
#[macro_export]
macro_rules! every_example {
    ($with:ident) => {
        $with! {
            cam: Cam;
            cam_drive: CamDrive;
            car: Car;
            chain: Chain;
            engine: Engine;
            excavator: Excavator;
            four_bar: FourBar;
            four_bar_ends: FourBarEnds;
            four_bar_loop: FourBarLoop;
            four_bar_relative: FourBarRelative;
            hart: Hart;
            hoecken: Hoecken;
            jansen: Jansen;
            klann: Klann;
            pantograph: Pantograph;
            peaucellier: Peaucellier;
            planetary: Planetary;
            pump_jack: PumpJack;
            quick_return: QuickReturn;
            rack_and_pinion: Steering;
            robot_3rrr: Robot3rrr;
            robot_closures: RobotClosures;
            scissor_lift: ScissorLift;
            scotch_yoke: ScotchYoke;
            sleigh: Sleigh;
            slider_crank: SliderCrank;
            squeezer: Squeezer;
            template: SliderCrank;
            toggle_press: TogglePress;
            wishbone: Wishbone;
        }
    };
}

macro_rules! programs {
    ($($name:ident: $Mechanism:ident;)+) => {
        #[allow(dead_code, unreachable_pub, missing_docs, reason = "programs of their own")]
        #[path = "../examples"]
        mod files {
            $(pub mod $name;)+
        }
        pub use files::*;

        /// The names of all files of examples.
        pub const NAMES: &[&str] = &[$(stringify!($name)),+];

        /// Runs the program of an example; `None` for an unknown name.
        pub fn run(name: &str, arguments: &[String]) -> Option<ExitCode> {
            match name {
                $(stringify!($name) => Some(cli::run_from::<$name::$Mechanism>(arguments)),)+
                _ => None,
            }
        }
    };
}

every_example!(programs);
