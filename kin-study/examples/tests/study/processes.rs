//! Programs that are interrupted, killed, or cannot write: what is finished is kept, and goes on.

use crate::{directory, table};
use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::os::unix::process::ExitStatusExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

/// A study that takes a thread some seconds.
pub(crate) const LONG: &str = "rows = 1e6\nseed = 3\n[parameters]\nl2 = { from = 0.3, to = 0.5 }\nl3 = { from = 0.2, to = 0.4 }\n\
    [motion]\nto = 6.28\nsteps = 199\n[scores]\nswing = { range = \"rocker.phi\" }\n\
    [keep]\nbest = 20\nby = \"swing desc\"\n";
/// One that takes no time, and keeps all of its rows.
pub(crate) const SHORT: &str = "rows = 20000\n[parameters]\nl2 = { from = 0.3, to = 0.5 }\n[motion]\nto = 1\nsteps = 4\n\
    [scores]\nswing = { range = \"rocker.phi\" }\n";

/// Where cargo puts the example programs.
pub(crate) fn program() -> PathBuf {
    example("four_bar")
}

pub(crate) fn example(name: &str) -> PathBuf {
    let own = std::env::current_exe().expect("a program has a path");
    let program = own.ancestors().nth(2).expect("it is in deps").join("examples").join(name);
    assert!(program.exists(), "{} is missing: `cargo test` without `--test` builds it", program.display());
    program
}

/// A directory with a study, and the command line for its rows.
pub(crate) struct Place {
    directory: tempfile::TempDir,
}

impl Place {
    pub(crate) fn new(study: &str) -> Self {
        let directory = directory();
        fs::write(directory.path().join("study.toml"), study).expect("it can be written");
        Self { directory }
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.directory.path().join(name)
    }

    /// The program with some words of its command line.
    pub(crate) fn command(&self, words: &str) -> Command {
        let mut command = Command::new(program());
        command.args(words.split_whitespace()).current_dir(self.directory.path());
        command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
        command
    }

    pub(crate) fn output(&self, words: &str) -> Output {
        self.command(words).output().expect("it starts")
    }

    /// What a program says that succeeds: on stdout and on stderr.
    pub(crate) fn success(&self, words: &str) -> [String; 2] {
        said(words, self.output(words), 0)
    }
}

pub(crate) fn said(what: &str, output: Output, status: i32) -> [String; 2] {
    let texts = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).expect("it is a text"));
    assert_eq!(output.status.code(), Some(status), "{what}: {texts:?}");
    texts
}

/// Waits until a program has worked for half a second.
pub(crate) fn working(child: &Child) {
    let began = Instant::now();
    loop {
        let stat = fs::read_to_string(format!("/proc/{}/stat", child.id())).expect("the process is there");
        let fields = stat.rsplit_once(')').expect("a name in brackets").1;
        // In hundredths of a second.
        let used: u64 = fields.split_whitespace().nth(11).and_then(|ticks| ticks.parse().ok()).expect("a number");
        if used >= 50 {
            return;
        }
        assert!(began.elapsed() < Duration::from_secs(60), "it does nothing: {stat}");
        std::thread::sleep(Duration::from_millis(20));
    }
}

pub(crate) fn signal(child: &Child, name: &str) {
    let kill = Command::new("kill").args([&format!("-{name}"), &child.id().to_string()]).status();
    assert!(kill.expect("there is a kill").success());
}

/// The rows that a run has done itself: `…; 4096 in 0.1 s, …`.
pub(crate) fn own(said: &str) -> u64 {
    let rows = said.split_once(" met all conditions; ").and_then(|(_, rest)| rest.split_once(" in "));
    rows.and_then(|(rows, _)| rows.parse().ok()).unwrap_or_else(|| panic!("no rows in {said}"))
}

/// The files of a directory whose names begin like this.
pub(crate) fn files(directory: &Path, start: &str) -> usize {
    let entries = fs::read_dir(directory).expect("it can be read").flatten();
    entries.filter(|entry| entry.file_name().to_string_lossy().starts_with(start)).count()
}

#[test]
fn an_interrupted_and_a_killed_run_go_on_where_they_were() {
    let place = Place::new(LONG);
    place.success("run study.toml --out whole --threads 1");

    let resume = "run study.toml --out broken --threads 1 --resume";
    let interrupted = place.command(resume).spawn().expect("it starts");
    working(&interrupted);
    signal(&interrupted, "INT");
    let [_, text] = said("INT", interrupted.wait_with_output().expect("it ends"), 130);
    assert!(text.contains("what is done is kept in broken; go on with --resume"), "{text}");
    let first = own(&text);
    assert!(0 < first && first < 1_000_000, "{text}");
    assert_eq!(files(&place.path("broken"), "rows-"), 1);

    let killed = place.command(resume).spawn().expect("it starts");
    working(&killed);
    // Nobody else computes the same rows meanwhile.
    let [_, text] = said("a second process", place.output(resume), 1);
    assert!(text.contains("another process is computing these rows"), "{text}");
    signal(&killed, "KILL");
    assert_eq!(killed.wait_with_output().expect("it ends").status.signal(), Some(9));

    let [_, text] = place.success(resume);
    assert!(own(&text) <= 1_000_000 - first, "{text}");
    assert!(table(&place.path("broken")) == table(&place.path("whole")));
}

#[test]
fn an_array_of_jobs_makes_the_table_of_one_run() {
    let place = Place::new(SHORT);
    place.success("run study.toml --out whole");
    assert_eq!(place.success("missing study.toml --out parts --of 6")[0], "0-5\n");
    // As the two job schedulers start it: a number for every job in its environment.
    let jobs = Path::new(env!("CARGO_MANIFEST_DIR")).join("jobs");
    let start = |script: &str, variables: &[(&str, &str)]| {
        let mut command = Command::new("bash");
        command.arg(jobs.join(script)).env("PROGRAM", program()).env("STUDY", "study.toml").env("OUT", "parts");
        command.env("PARTS", "6").envs(variables.iter().copied()).current_dir(place.directory.path());
        command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("there is a bash")
    };
    let slurm = |index| start("slurm.sh", &[("SLURM_ARRAY_TASK_ID", index), ("SLURM_CPUS_PER_TASK", "1")]);
    let hyperqueue = |index| start("hyperqueue.sh", &[("HQ_TASK_ID", index)]);
    for job in [slurm("4"), slurm("0"), slurm("2"), hyperqueue("5"), hyperqueue("3")] {
        said("a job", job.wait_with_output().expect("it ends"), 0);
    }
    // A job that is started once more has nothing to do.
    said("a job", hyperqueue("3").wait_with_output().expect("it ends"), 0);
    assert_eq!(place.success("missing study.toml --out parts --of 6")[0], "1\n");
    place.success("chunk study.toml --out parts --index 1 --of 6");
    assert_eq!(place.success("missing study.toml --out parts --of 6")[0], "\n");
    assert!(table(&place.path("parts")) == table(&place.path("whole")));

    let other = place.output("chunk study.toml --rows 30000 --out parts --index 1 --of 6 --resume");
    let [_, text] = said("another study", other, 1);
    assert!(text.contains("holds another study") && text.contains("30000"), "{text}");
}

#[test]
fn a_disk_without_room_is_named_and_what_is_finished_is_kept() {
    let place = Place::new(SHORT);
    place.success("run study.toml --out whole");
    place.success("chunk study.toml --out full --index 0 --of 2");
    // No file may grow beyond 64 blocks of 1024 bytes; without the trap a signal would end the program.
    let mut limited = Command::new("bash");
    limited.args(["-c", "trap '' XFSZ; ulimit -f 64; exec \"$0\" run study.toml --out full --resume"]);
    let limited = limited.arg(program()).current_dir(place.directory.path()).output().expect("there is a bash");
    let [_, text] = said("a full disk", limited, 1);
    assert!(text.contains("full/rows-0000000000010000-") && text.contains("File too large"), "{text}");
    assert_eq!((files(&place.path("full"), "rows-"), files(&place.path("full"), ".kin-")), (2, 0));
    let [_, text] = place.success("run study.toml --out full --resume");
    assert_eq!(own(&text), 10_000, "{text}");
    assert!(table(&place.path("full")) == table(&place.path("whole")));
}

#[test]
fn a_directory_that_cannot_be_written_is_named() {
    let place = Place::new(SHORT);
    let closed = place.path("closed");
    fs::create_dir(&closed).expect("it can be made");
    fs::set_permissions(&closed, fs::Permissions::from_mode(0o555)).expect("it is ours");
    // The superuser may write everywhere unless he gives that up.
    let mut modest = Command::new("setpriv");
    modest.args(["--bounding-set=-dac_override,-dac_read_search", "--inh-caps=-all"]).arg(program());
    let is_root = fs::write(closed.join("probe"), "").is_ok();
    let mut command = if is_root { modest } else { Command::new(program()) };
    command.args("run study.toml --out closed".split(' ')).current_dir(place.directory.path());
    let Ok(output) = command.output() else {
        println!("skipped: there is no setpriv");
        return;
    };
    let [_, text] = said("closed", output, 1);
    assert!(text.contains("error: closed/study.txt: ") && text.contains("Permission denied"), "{text}");
}

#[cfg(not(feature = "cluster"))]
#[test]
fn a_program_without_clusters_says_what_it_needs() {
    let place = Place::new(SHORT);
    for words in ["scheduler", "worker --scheduler localhost:1", "run study.toml --out out --standalone"] {
        let [_, text] = said(words, place.output(words), 2);
        assert!(text.contains("built without clusters: build it with kin-study's feature `cluster`"), "{text}");
    }
}
