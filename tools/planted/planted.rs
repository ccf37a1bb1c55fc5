//! Defects that sanitizers must find, one by the name that is given: a check that finds none of them is no check.

use std::thread;

static mut SHARED: u64 = 0;

fn main() {
    match std::env::args().nth(1).as_deref() {
        Some("use-after-free") => {
            let freed = Box::into_raw(Box::new(7u64));
            // SAFETY: none; this is the defect.
            unsafe {
                drop(Box::from_raw(freed));
                println!("{}", std::ptr::read_volatile(freed));
            }
        }
        Some("leak") => {
            std::hint::black_box(Box::leak(Box::new([1u8; 1000])));
            // Nothing on the stack points there any more.
            std::hint::black_box([0u8; 4096]);
        }
        Some("race") => {
            // SAFETY: none; this is the defect.
            let work = || unsafe {
                for _ in 0..100_000 {
                    let p = &raw mut SHARED;
                    std::ptr::write_volatile(p, std::ptr::read_volatile(p) + 1);
                }
            };
            let other = thread::spawn(work);
            work();
            other.join().expect("a thread");
        }
        _ => std::process::exit(0),
    }
}
