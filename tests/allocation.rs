//! Steps, derivatives, Jacobians after the first, and outputs do not allocate memory.
#![allow(unsafe_code)]

use cagedyn::{Model, Scene, Sim};
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::sync::Arc;

thread_local! {
    static ALLOCATIONS: Cell<u64> = const { Cell::new(0) };
}

/// The system allocator, counting the allocations of each thread.
struct Counting;

// SAFETY: every call goes to the system allocator unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let _ = ALLOCATIONS.try_with(|n| n.set(n.get() + 1));
        // SAFETY: as required of the caller.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: as required of the caller.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

fn allocations(action: impl FnOnce()) -> u64 {
    let before = ALLOCATIONS.get();
    action();
    ALLOCATIONS.get() - before
}

#[test]
fn nothing_is_allocated_while_a_simulation_runs() {
    let text = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/nu2310.json")).unwrap();
    for solver in [
        "{}",
        r#"{"method": {"auto": {"tolerance": 1e-5}}}"#,
        r#"{"method": {"leapfrog": {}}}"#,
        r#"{"method": {"dormand_prince": {"tolerance": 1e-5}}}"#,
        r#"{"method": {"adams": {"tolerance": 1e-5}}}"#,
        r#"{"method": {"rosenbrock": {"tolerance": 1e-5}}}"#,
        r#"{"method": {"radau": {"tolerance": 1e-5}}}"#,
    ] {
        let scene = Scene::from_json_with(&text, [("solver", solver)]).unwrap();
        let mut sim = Sim::new(Arc::new(Model::new(scene).unwrap())).unwrap();
        let mut outputs = vec![0.0; sim.channels().len()];
        let mut rate = vec![0.0; sim.state().len()];
        let state = sim.state().to_vec();
        sim.outputs(&mut outputs).unwrap();
        assert!(allocations(|| drop(std::hint::black_box(vec![0.0; 8]))) > 0, "the counter counts");
        assert_eq!(allocations(|| sim.advance_to(10e-3).unwrap()), 0, "steps, {solver}");
        assert_eq!(allocations(|| sim.outputs(&mut outputs).unwrap()), 0, "outputs, {solver}");
        assert_eq!(
            allocations(|| sim.derivative(0.0, &state, &mut rate).unwrap()),
            0,
            "derivative, {solver}"
        );
        let mut jacobian = vec![0.0; state.len() * state.len()];
        sim.jacobian(0.0, &state, &mut jacobian).unwrap();
        assert_eq!(
            allocations(|| sim.jacobian(0.0, &state, &mut jacobian).unwrap()),
            0,
            "second Jacobian, {solver}"
        );
        let mut x = state.clone();
        let mut newton = || {
            sim.linearize(0.0, &state).unwrap();
            sim.factorize(1e-6).unwrap();
            sim.solve(&mut x).unwrap();
        };
        newton();
        assert_eq!(allocations(newton), 0, "second Newton system, {solver}");
        assert_eq!(allocations(|| sim.set_state(0.0, &state).unwrap()), 0, "state, {solver}");
        assert_eq!(allocations(|| sim.set_input(0, -300.0).unwrap()), 0, "input, {solver}");
    }
}
