//! What hosts pay: a call of the C ABI over the same call in Rust, and 24 equal simulations of a batch on all cores over one core,
//! bit for bit those of one. `cargo bench --bench hosts` prints it.
#![allow(unsafe_code)]

use cagedyn::batch::{Monitor, advance_all};
use cagedyn::capi::integrator::cagedyn_sim_derivative;
use cagedyn::capi::model::{cagedyn_model_free, cagedyn_model_from_json};
use cagedyn::capi::sim::{cagedyn_sim_free, cagedyn_sim_new};
use cagedyn::{Model, Sim};
use std::error::Error;
use std::ffi::CString;
use std::sync::Arc;
use std::time::Instant;

const TEXT: &str = include_str!("../scenes/nu2310.json");
/// Simulated time at which rates are asked for, s.
const DEVELOPED: f64 = 0.01;
const CALLS: usize = 500;
const ROUNDS: usize = 10;
const PAIRS: usize = 101;
/// How much further the next pair lies, on the heap and on the stack, bytes.
const SHIFT: usize = 1344;
/// Pairs until one is as deep on the stack as the first.
const DEPTHS: usize = 16;
const RUNS: usize = 24;
/// Simulated time of each run of the batch, s.
const DURATION: f64 = 0.1;
const BATCHES: usize = 7;

struct One(Sim);

impl AsMut<Sim> for One {
    fn as_mut(&mut self) -> &mut Sim {
        &mut self.0
    }
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// Wall time of `work`, s.
fn time(mut work: impl FnMut()) -> f64 {
    let started = Instant::now();
    work();
    started.elapsed().as_secs_f64()
}

/// Does `work` so many shifts further down the stack.
fn deeper(shifts: usize, work: &mut dyn FnMut()) {
    let room = std::hint::black_box([0u8; SHIFT]);
    if shifts == 0 {
        work()
    } else {
        deeper(shifts - 1, work)
    }
    std::hint::black_box(room);
}

fn main() -> Result<(), Box<dyn Error>> {
    let model = Arc::new(Model::from_json(TEXT)?);
    let mut sim = Sim::new(model.clone())?;
    sim.advance_to(DEVELOPED)?;
    let (t, state) = (sim.time(), sim.state().to_vec());
    let n = state.len() as i64;
    let text = CString::new(TEXT)?;
    // SAFETY: a text; handles that live until they are freed below, and arrays of the length of the state.
    let handle = unsafe { cagedyn_model_from_json(text.as_ptr()) };
    let [mut in_rust, mut ratios] = [(); 2].map(|()| Vec::new());
    for pair in 0..PAIRS {
        // Where memory lies makes a simulation some per cent slower or faster, so all of it lies elsewhere every time, and either
        // simulation is made first half of the times.
        let _apart = Vec::<u8>::with_capacity(pair * SHIFT);
        let (state, mut rate) = (state.clone(), vec![0.0; state.len()]);
        let make = || Sim::new(model.clone()).map(Box::new);
        let rust_first = pair % 2 == 0;
        let first = if rust_first { Some(make()?) } else { None };
        // SAFETY: see above.
        let in_c = unsafe { cagedyn_sim_new(handle) };
        let mut own = first.map_or_else(make, Ok)?;
        let mut best = [f64::INFINITY; 2];
        deeper(pair % DEPTHS, &mut || {
            for _ in 0..ROUNDS {
                let rust = time(|| {
                    for _ in 0..CALLS {
                        own.derivative(t, &state, &mut rate).expect("rates");
                    }
                });
                let c = time(|| {
                    for _ in 0..CALLS {
                        // SAFETY: see above.
                        let status =
                            unsafe { cagedyn_sim_derivative(in_c, t, state.as_ptr(), rate.as_mut_ptr(), n) };
                        assert_eq!(status, 0);
                    }
                });
                best = [best[0].min(rust), best[1].min(c)];
            }
        });
        // SAFETY: it is not used any more.
        unsafe { cagedyn_sim_free(in_c) };
        in_rust.push(best[0] / CALLS as f64);
        ratios.push(best[1] / best[0]);
    }
    // SAFETY: it is not used any more.
    unsafe { cagedyn_model_free(handle) };
    println!(
        "rates of the NU2310: {:.0} ns in Rust; by the C ABI {:.4} times as long, median of {PAIRS} pairs of simulations",
        1e9 * median(in_rust),
        median(ratios)
    );

    let cores = std::thread::available_parallelism()?.get();
    let mut alone = Sim::new(model.clone())?;
    alone.advance_to(DURATION)?;
    let mut ratios = Vec::new();
    for _ in 0..BATCHES {
        let mut times = Vec::new();
        for threads in [1, cores] {
            let sims = (0..RUNS).map(|_| Ok(One(Sim::new(model.clone())?)));
            let mut sims = sims.collect::<Result<Vec<_>, Box<dyn Error>>>()?;
            times.push(time(|| {
                let results = advance_all(&mut sims, DURATION, threads, &Monitor::default());
                assert!(results.iter().all(Result::is_ok));
            }));
            assert!(sims.iter().all(|one| one.0.state() == alone.state()));
        }
        ratios.push(times[0] / times[1]);
    }
    println!(
        "a batch of {RUNS} equal runs on {cores} cores over one: throughput {:.2}, median of {BATCHES} pairs; all bits as alone",
        median(ratios)
    );
    Ok(())
}
