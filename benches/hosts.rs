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
const PAIRS: usize = 51;
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

fn main() -> Result<(), Box<dyn Error>> {
    let model = Arc::new(Model::from_json(TEXT)?);
    let mut sim = Sim::new(model.clone())?;
    sim.advance_to(DEVELOPED)?;
    let (t, state) = (sim.time(), sim.state().to_vec());
    let (n, mut rate) = (state.len() as i64, vec![0.0; state.len()]);
    let text = CString::new(TEXT)?;
    // SAFETY: a text; handles that live until they are freed below, and arrays of the length of the state.
    let handle = unsafe { cagedyn_model_from_json(text.as_ptr()) };
    let [mut in_rust, mut ratios] = [(); 2].map(|()| Vec::new());
    for _ in 0..PAIRS {
        // New ones every time: where the memory of a simulation lies makes a per cent.
        let mut own = Sim::new(model.clone())?;
        // SAFETY: see above.
        let in_c = unsafe { cagedyn_sim_new(handle) };
        let mut best = [f64::INFINITY; 2];
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
