//! Studies on a scheduler with workers, each a process of its own on the loopback interface: the same rows as on one machine,
//! whoever is killed.

use crate::processes::{LONG, Place, SHORT, example, files, own, program, said, signal, working};
use crate::table;
use kin_study::query;
use std::io::{BufRead, BufReader, Read, Write};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// Histograms beside the best rows.
const COUNTED: &str = "rows = 50000\nseed = 3\nsampling = \"sobol\"\n[parameters]\nl2 = { from = 0.1, to = 0.5 }\n\
    l3 = { from = 0.1, to = 0.4 }\n[conditions]\nafter = [\"swing > 0.2\"]\n[motion]\nto = 6.28\nsteps = 50\nmode = \"all\"\n\
    [scores]\nswing = { range = \"rocker.phi\" }\n[keep]\nbest = 7\nby = \"swing\"\n\
    histograms = [{ of = \"swing\", from = 0, to = 3, bins = 9 }]\n";

/// A process that ends with the test.
struct Member(Child);

impl Drop for Member {
    fn drop(&mut self) {
        // It may have ended before. A worker that is asked to end removes its files.
        let _ = Command::new("kill").args(["-TERM", &self.0.id().to_string()]).stderr(Stdio::null()).status();
        let _ = self.0.wait();
    }
}

/// A scheduler, and where it listens.
fn scheduler(program: &Path) -> (Member, String) {
    let mut command = Command::new(program);
    command.args(["scheduler", "--port", "0"]).stdin(Stdio::null()).stderr(Stdio::piped());
    let mut child = command.spawn().expect("it starts");
    let mut line = String::new();
    let mut said = BufReader::new(child.stderr.take().expect("it is piped"));
    said.read_line(&mut line).expect("it says where it is");
    let address = line.strip_prefix("scheduler at ").and_then(|rest| rest.split(';').next());
    (Member(child), address.unwrap_or_else(|| panic!("no address in {line}")).to_owned())
}

fn worker(program: &Path, scheduler: &str) -> Member {
    let mut command = Command::new(program);
    command.args(["worker", "--threads", "1", "--scheduler", scheduler]).stdin(Stdio::null()).stderr(Stdio::null());
    Member(command.spawn().expect("it starts"))
}

/// Waits until a directory has a finished file.
fn written(directory: &Path) {
    let began = Instant::now();
    while !directory.exists() || files(directory, "rows-") == 0 {
        assert!(began.elapsed() < Duration::from_secs(120), "nothing is written");
        std::thread::sleep(Duration::from_millis(20));
    }
}

#[test]
fn a_cluster_makes_the_rows_of_one_machine() {
    let (_scheduler, address) = scheduler(&program());
    let _workers = [worker(&program(), &address), worker(&program(), &address)];
    for (study, histogram) in [(SHORT, false), (COUNTED, true)] {
        let place = Place::new(study);
        let [_, alone] = place.success("run study.toml --out whole");
        for (name, words) in [
            ("here", "--standalone --threads 2".to_owned()),
            ("there", format!("--cluster {address}")),
            ("cut", format!("--cluster {address} --tasks 3")),
        ] {
            let [_, text] = place.success(&format!("run study.toml --out {name} {words}"));
            let counts = |text: &str| text.split(';').next().map(str::to_owned);
            assert_eq!(counts(&text), counts(&alone));
            assert!(table(&place.path(name)) == table(&place.path("whole")), "{name}");
            if histogram {
                let counts = |name| query(&place.path(name), "select * from histogram order by \"from\"");
                let [cluster, own] =
                    [counts(name), counts("whole")].map(|answer| answer.expect("it is there").to_string());
                assert_eq!(cluster, own);
            }
        }
    }
}

#[test]
fn a_worker_that_is_killed_costs_time_alone() {
    let (_scheduler, address) = scheduler(&program());
    let (lost, _left) = (worker(&program(), &address), worker(&program(), &address));
    let place = Place::new(LONG);
    place.success("run study.toml --out whole");
    let run = place.command(&format!("run study.toml --out cluster --cluster {address}")).spawn().expect("it starts");
    working(&lost.0);
    signal(&lost.0, "KILL");
    let [_, text] = said("a cluster", run.wait_with_output().expect("it ends"), 0);
    assert_eq!(own(&text), 1_000_000, "{text}");
    assert!(table(&place.path("cluster")) == table(&place.path("whole")));
}

#[test]
fn without_its_scheduler_a_run_ends_and_keeps_what_is_finished() {
    let (lost, address) = scheduler(&program());
    let _worker = worker(&program(), &address);
    let place = Place::new(&LONG.replace("rows = 1e6", "rows = 1e7"));
    let run = place.command(&format!("run study.toml --out broken --cluster {address}")).spawn().expect("it starts");
    written(&place.path("broken"));
    signal(&lost.0, "KILL");
    let began = Instant::now();
    let [_, text] = said("a lost scheduler", run.wait_with_output().expect("it ends"), 1);
    assert!(
        began.elapsed() < Duration::from_secs(60) && text.contains(&format!("no scheduler answers at {address}")),
        "{text}"
    );
    assert!(text.contains("what is done is kept; go on with --resume"), "{text}");
    assert!(files(&place.path("broken"), "rows-") > 0);

    // Another scheduler goes on, until it is interrupted.
    let (_scheduler, address) = scheduler(&program());
    let _worker = worker(&program(), &address);
    let before = files(&place.path("broken"), "rows-");
    let resume = format!("run study.toml --out broken --resume --cluster {address}");
    let run = place.command(&resume).spawn().expect("it starts");
    let began = Instant::now();
    while files(&place.path("broken"), "rows-") == before {
        assert!(began.elapsed() < Duration::from_secs(120), "nothing is written");
        std::thread::sleep(Duration::from_millis(20));
    }
    signal(&run, "INT");
    let [_, text] = said("INT", run.wait_with_output().expect("it ends"), 130);
    assert!(text.contains("what is done is kept in broken; go on with --resume") && own(&text) > 0, "{text}");
}

#[test]
fn who_is_not_there_and_who_is_another_program_is_named() {
    let place = Place::new(SHORT);
    let run = |address: &str| said(address, place.output(&format!("run study.toml --out out --cluster {address}")), 1);
    let [_, text] = run("127.0.0.1:9");
    assert!(text.contains("no scheduler answers at 127.0.0.1:9"), "{text}");
    let [_, text] = said("no port", place.output("run study.toml --out out --cluster somewhere"), 2);
    assert!(text.contains("`somewhere` is no address of a scheduler: write HOST:PORT"), "{text}");
    let [_, text] = said("no name", place.output("scheduler --bind 0.0.0.0 --port 0"), 2);
    assert!(text.contains("say by which name the others reach it, --host HOST"), "{text}");

    let (_scheduler, address) = scheduler(&program());
    let [_, text] = run(&address);
    assert!(text.contains(&format!("{address} has no workers; start some: `worker --scheduler {address}`")), "{text}");
    // A worker and a client that are another program are refused at once.
    let _own = worker(&program(), &address);
    let foreign = |words: &str| {
        let output = Command::new(example("press")).args(words.split(' ')).current_dir(place.path("")).output();
        let [_, text] = said(words, output.expect("it starts"), 1);
        assert!(text.contains(&format!("{address}: the scheduler or a worker is another program")), "{text}");
    };
    foreign(&format!("worker --scheduler {address}"));
    let press = Path::new(env!("CARGO_MANIFEST_DIR")).join("press.toml");
    foreign(&format!("run {} --out press --cluster {address}", press.display()));
    place.success(&format!("run study.toml --out own --cluster {address}"));

    let other = std::net::TcpListener::bind("127.0.0.1:0").expect("there is a port");
    let address = other.local_addr().expect("it has one").to_string();
    std::thread::spawn(move || {
        for mut stream in other.incoming().flatten() {
            let _ = stream.read(&mut [0; 1024]);
            let _ = stream.write_all(b"HTTP/1.1 404 Not Found\r\n\r\n");
        }
    });
    let [_, text] = run(&address);
    assert!(text.contains(&format!("the server at {address} is not a kin-study scheduler")), "{text}");
}

#[test]
fn a_worker_that_is_frozen_is_done_without() {
    let (_scheduler, address) = scheduler(&program());
    let (frozen, _left) = (worker(&program(), &address), worker(&program(), &address));
    let place = Place::new(LONG);
    place.success("run study.toml --out whole");
    let run = place.command(&format!("run study.toml --out cluster --cluster {address}")).spawn().expect("it starts");
    working(&frozen.0);
    signal(&frozen.0, "STOP");
    let [_, text] = said("a cluster", run.wait_with_output().expect("it ends"), 0);
    signal(&frozen.0, "CONT");
    assert_eq!(own(&text), 1_000_000, "{text}");
    assert!(table(&place.path("cluster")) == table(&place.path("whole")));
}
