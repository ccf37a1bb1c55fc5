//! Work that is shared among threads.

use cagedyn::{Model, Scene};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc;

/// As many threads as there are cores, unless another number is asked for.
pub fn threads(asked: Option<u16>) -> usize {
    let cores = || std::thread::available_parallelism().map_or(1, usize::from);
    asked.map_or_else(cores, usize::from)
}

/// The places of these scenes, those that take longest first: by simulated time, fastest vibration and number of elements.
pub fn longest_first(scenes: &[Scene]) -> Vec<usize> {
    let cost = |scene: &Scene| {
        let steps = Model::new(scene.clone()).map_or(0.0, |model| model.highest_frequency());
        scene.record.duration * steps * f64::from(scene.element_count())
    };
    let costs: Vec<f64> = scenes.iter().map(cost).collect();
    let mut order: Vec<usize> = (0..scenes.len()).collect();
    order.sort_by(|a, b| costs[*b].total_cmp(&costs[*a]));
    order
}

/// Does `work` for each of these items on so many threads, in this order, and hands the results to `take` on this one as they
/// come. Work for which there is `None` ends the sharing, and so does `take` when it says no; what runs then comes to its end.
pub fn share<R: Send>(
    items: &[usize],
    threads: usize,
    work: impl Fn(usize) -> Option<R> + Sync,
    mut take: impl FnMut(usize, R) -> bool,
) {
    let (next, wanted, (results, taken)) = (AtomicUsize::new(0), AtomicBool::new(true), mpsc::channel());
    std::thread::scope(|scope| {
        for _ in 0..threads.clamp(1, items.len().max(1)) {
            let (results, next, wanted, work) = (results.clone(), &next, &wanted, &work);
            scope.spawn(move || {
                while wanted.load(Ordering::Relaxed)
                    && let Some(item) = items.get(next.fetch_add(1, Ordering::Relaxed))
                    && let Some(result) = work(*item)
                    && results.send((*item, result)).is_ok()
                {}
            });
        }
        drop(results);
        while let Ok((item, result)) = taken.recv() {
            if !take(item, result) {
                break;
            }
        }
        wanted.store(false, Ordering::Relaxed);
        drop(taken);
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_item_is_done_once_whatever_the_number_of_threads() {
        let items: Vec<usize> = (0..37).rev().collect();
        for threads in [1, 2, 5, 100] {
            let mut done = vec![0; items.len()];
            share(
                &items,
                threads,
                |item| Some(2 * item),
                |item, result| {
                    assert_eq!(result, 2 * item);
                    done[item] += 1;
                    true
                },
            );
            assert_eq!(done, vec![1; items.len()]);
        }
        share(&[], 3, Some, |_, _| panic!("nothing to do"));
    }

    #[test]
    fn it_ends_when_there_is_no_result_or_none_is_wanted() {
        let items: Vec<usize> = (0..1000).collect();
        let mut taken = 0;
        share(
            &items,
            1,
            |item| (item < 10).then_some(item),
            |_, _| {
                taken += 1;
                true
            },
        );
        assert_eq!(taken, 10);
        share(&items, 2, Some, |_, _| {
            taken += 1;
            taken < 15
        });
        assert_eq!(taken, 15);
    }
}
