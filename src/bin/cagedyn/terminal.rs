//! Standard output and error, the progress bar and the signals that end a run.

use cagedyn::sim::{Canceller, RunLimits};
use cagedyn::{Error, Result, Status};
use indicatif::{HumanDuration, MultiProgress, ProgressBar, ProgressStyle};
use std::cell::Cell;
use std::io::{self, ErrorKind, IsTerminal, Write};
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{LazyLock, Mutex, MutexGuard, OnceLock, PoisonError};
use std::time::{Duration, Instant};

/// Exit code of a run that Ctrl-C or another request to end it ended, as shells use it for an interrupt signal.
pub const INTERRUPTED: u8 = 130;

/// Ticks of the progress bar per second of simulated time; fine enough for the shortest useful run.
const TICKS_PER_SECOND: f64 = 1e6;

/// A second signal sooner than this is taken for a copy of the first: some programs signal both the process and its
/// group.
const SAME_SIGNAL: Duration = Duration::from_millis(300);

/// Time between looks at how far a search is.
const LOOK: Duration = Duration::from_millis(100);

static STOP: OnceLock<Instant> = OnceLock::new();
static RUNNING: Mutex<Vec<Canceller>> = Mutex::new(Vec::new());
static BARS: LazyLock<MultiProgress> = LazyLock::new(MultiProgress::new);
static QUIET: AtomicBool = AtomicBool::new(false);

/// From now on nothing is printed to standard output, and there is no progress.
pub fn be_quiet() {
    QUIET.store(true, Ordering::Relaxed);
}

fn is_quiet() -> bool {
    QUIET.load(Ordering::Relaxed)
}

/// Whether progress can be seen.
fn shows_progress() -> bool {
    io::stderr().is_terminal() && !is_quiet()
}

/// Lets Ctrl-C stop this simulation, too, within a step.
pub fn stop_with(canceller: Canceller) {
    if let Ok(mut running) = RUNNING.lock() {
        running.push(canceller);
    }
}

/// Ends all simulations that Ctrl-C stops.
pub fn stop_all() {
    if let Ok(running) = RUNNING.lock() {
        running.iter().for_each(Canceller::cancel);
    }
}

/// Whether Ctrl-C was pressed.
pub fn stop_requested() -> bool {
    STOP.get().is_some()
}

/// From now on the first Ctrl-C, SIGTERM or SIGHUP asks the run to end and keep its results; the second ends the program at once.
///
/// # Errors
/// [`Status::Internal`] when the system refuses the handler.
pub fn listen_for_interrupt() -> Result<()> {
    let handler = || {
        if STOP.get_or_init(Instant::now).elapsed() > SAME_SIGNAL {
            std::process::exit(i32::from(INTERRUPTED));
        }
        stop_all();
    };
    #[cfg(unix)]
    keep_limit_on_files_an_error()?;
    ctrlc::set_handler(handler).map_err(|e| Error::new(Status::Internal, format!("Ctrl-C handler: {e}")))
}

/// A file that may not grow is an error of its own; the signal for it would end the program in the middle of a row.
#[cfg(unix)]
#[expect(unsafe_code, reason = "signals are those of the C library")]
fn keep_limit_on_files_an_error() -> Result<()> {
    // SAFETY: a signal that is ignored runs no code.
    match unsafe { libc::signal(libc::SIGXFSZ, libc::SIG_IGN) } {
        libc::SIG_ERR => {
            Err(Error::new(Status::Internal, format!("signal SIGXFSZ: {}", io::Error::last_os_error())))
        }
        _ => Ok(()),
    }
}

/// Prints text to standard output. A reader that closed the pipe early is no failure.
///
/// # Errors
/// [`Status::File`] when standard output cannot be written.
pub fn print(text: &str) -> Result<()> {
    if is_quiet() {
        return Ok(());
    }
    let write = || {
        let mut out = io::stdout().lock();
        out.write_all(text.as_bytes()).and_then(|()| out.flush())
    };
    match if io::stderr().is_terminal() { BARS.suspend(write) } else { write() } {
        Err(e) if e.kind() != ErrorKind::BrokenPipe => {
            Err(Error::new(Status::File, format!("standard output: {e}")))
        }
        _ => Ok(()),
    }
}

/// Prints a warning as one line on standard error.
pub fn warn(text: &str) {
    // Nothing is left to tell if standard error itself is closed.
    let _ = writeln!(io::stderr(), "cagedyn: warning: {text}");
}

/// Prints an error as one line on standard error.
pub fn complain(error: &Error) {
    // Nothing is left to tell if standard error itself is closed.
    let _ = writeln!(io::stderr(), "cagedyn: {error}");
}

/// Progress of one run over simulated time; visible only if standard error is a terminal.
pub struct Progress {
    bar: ProgressBar,
}

impl Progress {
    /// A bar for a run of `duration` seconds with a short label.
    pub fn new(label: &str, duration: f64) -> Self {
        if !shows_progress() {
            return Self { bar: ProgressBar::hidden() };
        }
        let bar = BARS.add(ProgressBar::new((duration * TICKS_PER_SECOND) as u64));
        let template = "{prefix} [{bar:40}] {percent:>3}% {msg} (eta {eta})";
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style.progress_chars("=> "));
        }
        bar.set_prefix(label.to_owned());
        Self { bar }
    }

    /// Moves the bar to simulated time `t` in s.
    pub fn at(&self, t: f64) {
        if self.bar.is_hidden() {
            return;
        }
        self.bar.set_position((t * TICKS_PER_SECOND) as u64);
        self.bar.set_message(format!("{t:.4} s"));
    }

    /// Moves the bar to this share of a way of length 1, with so many pieces of the result.
    fn share(&self, share: f64, found: usize) {
        self.bar.set_position((share * TICKS_PER_SECOND) as u64);
        self.bar.set_message(format!("{found} found"));
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

/// Does a search that Ctrl-C, or this wall time in s, ends, and shows how far it is.
///
/// # Errors
/// As [`listen_for_interrupt`], and a wall time that is none.
pub fn search<T>(label: &str, wall_time: Option<f64>, search: impl FnOnce(&RunLimits) -> T) -> Result<T> {
    listen_for_interrupt()?;
    let mut limits = RunLimits::default();
    limits.set_wall_time(wall_time.unwrap_or(f64::INFINITY))?;
    stop_with(limits.canceller());
    let bar = Progress::new(label, 1.0);
    let done = AtomicBool::new(false);
    Ok(std::thread::scope(|scope| {
        let show = || {
            while !done.load(Ordering::Relaxed) {
                bar.share(limits.share(), limits.found());
                std::thread::park_timeout(LOOK);
            }
        };
        let shown = shows_progress().then(|| scope.spawn(show));
        let found = search(&limits);
        done.store(true, Ordering::Relaxed);
        shown.inspect(|shown| shown.thread().unpark());
        found
    }))
}

/// How a program ends after something that a host can end early; 130 after Ctrl-C, 1 after a limit on the wall time.
pub fn ended_by(error: Option<&Error>) -> ExitCode {
    let Some(error) = error else { return ExitCode::SUCCESS };
    complain(error);
    if error.status == Status::Cancelled { ExitCode::from(INTERRUPTED) } else { ExitCode::FAILURE }
}

/// Progress of many runs in one line: done, running, failed, time left; visible only if standard error is a terminal.
pub struct Together {
    bar: ProgressBar,
    counts: Mutex<Counts>,
    started: Instant,
}

struct Counts {
    all: usize,
    /// Done before this program was started.
    earlier: usize,
    done: usize,
    failed: usize,
    running: usize,
    /// Runs that are done by now, with the parts of those that run.
    work: f64,
}

/// Ticks of the bar per run.
const TICKS_PER_RUN: f64 = 1e3;

impl Together {
    /// A line for `all` runs, of which so many are `done` already, and so many of these `failed`.
    pub fn new(all: usize, done: usize, failed: usize) -> Self {
        let bar = if shows_progress() {
            BARS.add(ProgressBar::new((all as f64 * TICKS_PER_RUN) as u64))
        } else {
            ProgressBar::hidden()
        };
        if let Ok(style) = ProgressStyle::with_template("[{bar:40}] {msg}") {
            bar.set_style(style.progress_chars("=> "));
        }
        let counts = Counts { all, earlier: done, done, failed, running: 0, work: 0.0 };
        Self { bar, counts: Mutex::new(counts), started: Instant::now() }
    }

    /// One of them begins.
    pub fn begin(&self) -> Part<'_> {
        let mut counts = self.lock();
        counts.running += 1;
        self.show(&counts);
        Part { of: self, share: Cell::new(0.0) }
    }

    fn lock(&self) -> MutexGuard<'_, Counts> {
        self.counts.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn show(&self, counts: &Counts) {
        if !self.bar.is_hidden() {
            self.bar.set_position(((counts.earlier as f64 + counts.work) * TICKS_PER_RUN) as u64);
            self.bar.set_message(counts.in_words(self.started.elapsed()));
        }
    }
}

impl Drop for Together {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

impl Counts {
    /// "12 of 40 done, 2 running, 1 failed, 3 minutes left".
    fn in_words(&self, spent: Duration) -> String {
        let mut text = format!("{} of {} done, {} running", self.done, self.all, self.running);
        if self.failed > 0 {
            text += &format!(", {} failed", self.failed);
        }
        let left = (self.all - self.earlier) as f64 - self.work;
        if self.work > 0.0 && left > 0.0 {
            // At most a century.
            let seconds = (spent.as_secs_f64() * left / self.work).min(3e9);
            text += &format!(", {} left", HumanDuration(Duration::from_secs_f64(seconds)));
        }
        text
    }
}

/// One run of [`Together`]; one that is dropped was left before its end.
pub struct Part<'a> {
    of: &'a Together,
    share: Cell<f64>,
}

impl Part<'_> {
    /// So much of the run is done, from 0 to 1.
    pub fn at(&self, share: f64) {
        let share = share.clamp(0.0, 1.0);
        let mut counts = self.of.lock();
        counts.work += share - self.share.replace(share);
        self.of.show(&counts);
    }

    /// The run is done, or has failed.
    pub fn end(self, failed: bool) {
        self.at(1.0);
        let mut counts = self.of.lock();
        counts.done += 1;
        counts.failed += usize::from(failed);
        // What is done stays done.
        self.share.set(0.0);
    }
}

impl Drop for Part<'_> {
    fn drop(&mut self) {
        let mut counts = self.of.lock();
        counts.running -= 1;
        counts.work -= self.share.get();
        self.of.show(&counts);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_runs_are_told_in_one_line() {
        let together = Together::new(40, 10, 1);
        let (first, second, third) = (together.begin(), together.begin(), together.begin());
        first.end(false);
        second.at(0.5);
        let told = || together.lock().in_words(Duration::from_secs(60));
        assert_eq!(told(), "11 of 40 done, 2 running, 1 failed, 19 minutes left");
        third.end(true);
        drop(second);
        assert_eq!(told(), "12 of 40 done, 0 running, 2 failed, 14 minutes left");
    }
}
