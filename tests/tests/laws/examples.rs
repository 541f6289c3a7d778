//! Every example as a program: its typeset equations agree with its code, and its commands are run.

#![allow(dead_code, unreachable_pub, missing_docs, reason = "programs of their own")]

use crate::typeset;
use kin_runtime::cli;
use std::process::ExitCode;

/// Defines a module for every example, and a test of its equations.
macro_rules! examples {
    ($($name:ident = $path:literal: $Mechanism:ident;)+) => {
        $(
            #[path = $path]
            mod $name;
        )+

        /// The names of all files of examples are listed here.
        const NAMES: &[&str] = &[$(stringify!($name)),+];

        /// Runs the program of an example; `None` for an unknown name.
        pub(crate) fn run(name: &str, arguments: &[String]) -> Option<ExitCode> {
            match name {
                $(stringify!($name) => Some(cli::run_from::<$name::$Mechanism>(arguments)),)+
                _ => None,
            }
        }

        mod typeset_equations {
            $(
                #[test]
                fn $name() {
                    super::typeset::typeset_equations_are_the_code::<super::$name::$Mechanism>();
                }
            )+
        }
    };
}

examples! {
    cam = "../../../examples/cam.rs": Cam;
    cam_drive = "../../../examples/cam_drive.rs": CamDrive;
    car = "../../../examples/car.rs": Car;
    chain = "../../../examples/chain.rs": Chain;
    engine = "../../../examples/engine.rs": Engine;
    excavator = "../../../examples/excavator.rs": Excavator;
    four_bar = "../../../examples/four_bar.rs": FourBar;
    four_bar_ends = "../../../examples/four_bar_ends.rs": FourBarEnds;
    four_bar_loop = "../../../examples/four_bar_loop.rs": FourBarLoop;
    four_bar_relative = "../../../examples/four_bar_relative.rs": FourBarRelative;
    hart = "../../../examples/hart.rs": Hart;
    hoecken = "../../../examples/hoecken.rs": Hoecken;
    jansen = "../../../examples/jansen.rs": Jansen;
    klann = "../../../examples/klann.rs": Klann;
    pantograph = "../../../examples/pantograph.rs": Pantograph;
    peaucellier = "../../../examples/peaucellier.rs": Peaucellier;
    planetary = "../../../examples/planetary.rs": Planetary;
    pump_jack = "../../../examples/pump_jack.rs": PumpJack;
    quick_return = "../../../examples/quick_return.rs": QuickReturn;
    rack_and_pinion = "../../../examples/rack_and_pinion.rs": Steering;
    robot_3rrr = "../../../examples/robot_3rrr.rs": Robot3rrr;
    robot_closures = "../../../examples/robot_closures.rs": RobotClosures;
    scissor_lift = "../../../examples/scissor_lift.rs": ScissorLift;
    scotch_yoke = "../../../examples/scotch_yoke.rs": ScotchYoke;
    sleigh = "../../../examples/sleigh.rs": Sleigh;
    slider_crank = "../../../examples/slider_crank.rs": SliderCrank;
    squeezer = "../../../examples/squeezer.rs": Squeezer;
    template = "../../../examples/template.rs": SliderCrank;
    toggle_press = "../../../examples/toggle_press.rs": TogglePress;
    wishbone = "../../../examples/wishbone.rs": Wishbone;
}

#[test]
fn no_example_is_left_out() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples");
    let files = std::fs::read_dir(folder).expect("the examples").map(|entry| entry.expect("a file").file_name());
    let mut found: Vec<String> = files
        .filter_map(|file| file.to_str()?.strip_suffix(".rs").map(str::to_owned))
        .filter(|name| name != "lib")
        .collect();
    found.sort();
    let mut names = NAMES.to_vec();
    names.sort_unstable();
    assert_eq!(names, found);
}
