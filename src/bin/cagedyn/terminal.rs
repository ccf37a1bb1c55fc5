//! Standard output and error, the progress bar and the signals that end a run.

use cagedyn::sim::Canceller;
use cagedyn::{Error, Result, Status};
use indicatif::{MultiProgress, ProgressBar, ProgressStyle};
use std::io::{self, ErrorKind, IsTerminal, Write};
#[cfg(unix)]
use std::sync::{Arc, atomic::AtomicBool};
use std::sync::{LazyLock, Mutex, OnceLock};
use std::time::{Duration, Instant};

/// Exit code of a run that Ctrl-C or another request to end it ended, as shells use it for an interrupt signal.
pub const INTERRUPTED: u8 = 130;

/// Ticks of the progress bar per second of simulated time; fine enough for the shortest useful run.
const TICKS_PER_SECOND: f64 = 1e6;

/// A second signal sooner than this is taken for a copy of the first: some programs signal both the process and its
/// group.
const SAME_SIGNAL: Duration = Duration::from_millis(300);

static STOP: OnceLock<Instant> = OnceLock::new();
static RUNNING: Mutex<Vec<Canceller>> = Mutex::new(Vec::new());
static BARS: LazyLock<MultiProgress> = LazyLock::new(MultiProgress::new);

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
    // A file that may not grow is an error of its own; the signal for it would end the program in the middle of a row.
    #[cfg(unix)]
    signal_hook::flag::register(signal_hook::consts::SIGXFSZ, Arc::new(AtomicBool::new(false)))
        .map_err(|e| Error::new(Status::Internal, format!("signal handler: {e}")))?;
    ctrlc::set_handler(handler).map_err(|e| Error::new(Status::Internal, format!("Ctrl-C handler: {e}")))
}

/// Prints text to standard output. A reader that closed the pipe early is no failure.
///
/// # Errors
/// [`Status::File`] when standard output cannot be written.
pub fn print(text: &str) -> Result<()> {
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
        if !io::stderr().is_terminal() {
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
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
