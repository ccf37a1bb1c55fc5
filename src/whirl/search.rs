//! Every steady whirl of a rigid cage, by a search over its place and speed.
//!
//! At a given eccentricity and whirl speed the lead follows from the moment, which grows with it. Whirl speeds at which then no force acts
//! across the eccentricity are found between two neighbours of a grid where it changes its sign; from one eccentricity to the next
//! these are followed, and where the force along the eccentricity comes to balance that of the circular motion, Newton's method starts.

use super::averaged::Averaged;
use super::{Whirl, solve};
use crate::error::Result;
use crate::scalar::math;

/// Places within a layer: shares of its thickness, as arcs begin and as the gap closes.
const OF_LAYER: [f64; 20] = [
    1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 5e-3, 0.015, 0.04, 0.08, 0.14, 0.22, 0.32, 0.43, 0.55, 0.67, 0.78, 0.87,
    0.94, 0.98, 0.999,
];
/// Places in a clearance that has no layer, or is full: shares of it.
const OF_CLEARANCE: [f64; 13] = [0.01, 0.04, 0.1, 0.2, 0.3, 0.42, 0.54, 0.66, 0.77, 0.86, 0.93, 0.98, 0.999];
/// Places beyond the clearance of the guide, or of the pockets, where surfaces are pressed together: shares of it.
const BEYOND: [f64; 7] = [1e-4, 1e-3, 5e-3, 0.02, 0.06, 0.15, 0.3];
/// Slowest speed as a share of that of the elements, the fastest as that of the fastest vibration.
const SLOWEST: f64 = 0.02;
const FASTEST: f64 = 1.0;
/// Places of the train that means are over, and the ratio of neighbouring speeds: quickly, and thoroughly.
const QUICK: (usize, f64) = (20, 2.0);
const THOROUGH: (usize, f64) = (60, 1.6);
/// First step of the lead, rad, how it grows until the moment changes its sign, and where that ends.
const FIRST_LEAD: f64 = 1e-7;
const LEAD_GROWTH: f64 = 4.0;
const FARTHEST_LEAD: f64 = 0.1;
/// Steps that close in on a root. They end at a change of the speed by this share, and where the moment is this small beside the force
/// across, or that along: Newton's method goes on from there.
const MOST_STEPS: usize = 40;
const CLOSE: f64 = 1e-4;
const BESIDE_ACROSS: f64 = 1e-2;
const BESIDE_ALONG: f64 = 1e-6;
/// Two roots that agree to this share are one.
const SAME: f64 = 1e-4;

/// What a search has come to.
pub(super) struct Search {
    /// Whirls, those that are stable first, then by their speed.
    pub(super) whirls: Vec<Whirl>,
    /// Eccentricities, m, and magnitudes of the whirl speed, rad/s, between which it has looked.
    pub(super) eccentricities: [f64; 2],
    pub(super) speeds: [f64; 2],
}

impl Search {
    fn sort(&mut self) {
        let order =
            |a: &Whirl, b: &Whirl| b.stable().cmp(&a.stable()).then(b.speed.abs().total_cmp(&a.speed.abs()));
        self.whirls.sort_by(order);
    }

    /// What it says where it has found none.
    pub(super) fn in_words(&self) -> String {
        let ([near, far], [slow, fast]) = (self.eccentricities, self.speeds);
        format!(
            "there is no steady whirl, the cage can only rest: looked at eccentricities from {near:.1e} to {far:.1e} m and whirl speeds from \
             {slow:.1e} to {fast:.1e} rad/s in both directions"
        )
    }
}

/// A whirl speed without force across the eccentricity.
#[derive(Clone, Copy)]
struct Crossing {
    speed: f64,
    lead: f64,
    /// Acceleration along the eccentricity that is left, m/s^2.
    along: f64,
    /// Whether the force grows with the speed.
    grows: bool,
}

/// Looks for the steady whirls of a rigid cage: for all, or until a stable one is found.
///
/// # Errors
/// Requests to stop only.
pub(super) fn search(averaged: &mut Averaged, all: bool) -> Result<Search> {
    if !all {
        let quick = pass(averaged, QUICK, false)?;
        if quick.whirls.first().is_some_and(Whirl::stable) {
            return Ok(quick);
        }
    }
    pass(averaged, THOROUGH, all)
}

/// One pass over places and speeds.
fn pass(averaged: &mut Averaged, (train, ratio): (usize, f64), all: bool) -> Result<Search> {
    let paths = paths(averaged);
    let orbit = averaged.orbit().abs();
    let (slowest, fastest) =
        (SLOWEST * orbit, FASTEST * averaged.model().highest_frequency().max(10.0 * orbit));
    let count = (math::ln(fastest / slowest) / math::ln(ratio)).ceil() as i32;
    let magnitudes: Vec<f64> = (0..=count).map(|i| slowest * ratio.powi(i)).collect();
    let ends = |list: &mut dyn Iterator<Item = f64>| {
        list.fold([f64::INFINITY, 0.0f64], |[low, high], x| [low.min(x), high.max(x)])
    };
    let mut found = Search {
        whirls: Vec::new(),
        eccentricities: ends(&mut paths.iter().flatten().copied()),
        speeds: ends(&mut magnitudes.iter().copied()),
    };
    for places in &paths {
        let mut before: Option<(f64, Vec<Crossing>)> = None;
        for eccentricity in places {
            let first = averaged.place_at(*eccentricity);
            averaged.set_train(Some(train));
            let here = crossings(averaged, first, -1.0, &magnitudes).and_then(|mut here| {
                here.extend(crossings(averaged, first, 1.0, &magnitudes)?);
                Ok(here)
            });
            averaged.set_train(None);
            let here = here?;
            for (near, a) in before.iter().flat_map(|(near, there)| there.iter().map(move |a| (*near, a))) {
                for b in &here {
                    let Some(whirl) = between((near, a), (first, b), averaged)? else { continue };
                    let last = !all && whirl.stable();
                    if !found.whirls.iter().any(|other| same(other, &whirl)) {
                        found.whirls.push(whirl);
                    }
                    if last {
                        found.sort();
                        return Ok(found);
                    }
                }
            }
            before = Some((first, here));
        }
    }
    found.sort();
    Ok(found)
}

/// The whirl between two places, each with a speed at which no force acts across, if that along changes its sign.
fn between(
    (near, a): (f64, &Crossing),
    (far, b): (f64, &Crossing),
    averaged: &mut Averaged,
) -> Result<Option<Whirl>> {
    if a.grows != b.grows || a.speed * b.speed < 0.0 || a.along * b.along > 0.0 {
        return Ok(None);
    }
    for share in [a.along / (a.along - b.along), 0.5, 0.0, 1.0] {
        let mixed = |a: f64, b: f64| a + share * (b - a);
        let start = [mixed(near, far), mixed(a.speed, b.speed), mixed(a.lead, b.lead)];
        match solve(averaged, start.to_vec()) {
            Ok(whirl) => return Ok(Some(whirl)),
            Err(e) if e.is_stop() => return Err(e),
            Err(_) => {}
        }
    }
    Ok(None)
}

fn same(a: &Whirl, b: &Whirl) -> bool {
    let near = |a: f64, b: f64| (a - b).abs() < SAME * b.abs();
    near(a.speed, b.speed) && near(a.eccentricity, b.eccentricity)
}

/// Eccentricities to look at one after the other, m: where the guide has forces, and beside its layer, where pockets may have some.
fn paths(averaged: &Averaged) -> Vec<Vec<f64>> {
    let (clearance, play) = (averaged.clearance(), averaged.play());
    let beyond = |start: f64| BEYOND.map(|share| start * (1.0 + share));
    let edge = averaged.inside().unwrap_or(0.0);
    let mut guided: Vec<f64> = match averaged.inside() {
        Some(inside) => OF_LAYER.map(|share| inside + share * (clearance - inside)).to_vec(),
        None => OF_CLEARANCE.map(|share| share * clearance).to_vec(),
    };
    guided.extend(beyond(clearance).into_iter().chain(beyond(play)));
    guided.retain(|place| *place > edge && *place <= beyond(clearance)[BEYOND.len() - 1]);
    guided.sort_by(f64::total_cmp);
    let mut beside = beyond(play).to_vec();
    beside.retain(|place| *place < edge);
    // They meet at the edge.
    beside.extend(guided.first().filter(|_| play < edge));
    vec![guided, beside]
}

/// Speeds of this direction at which no force acts across the eccentricity. Where forces have no value there is none.
fn crossings(averaged: &mut Averaged, place: f64, sign: f64, magnitudes: &[f64]) -> Result<Vec<Crossing>> {
    let mut found = Vec::new();
    let mut before: Option<(f64, Balanced)> = None;
    for magnitude in magnitudes {
        let speed = sign * magnitude;
        let near = before.as_ref().map_or(0.0, |(_, balanced)| balanced.lead);
        let here = balanced(averaged, place, speed, near)?;
        if let (Some((slower, a)), Some(b)) = (&before, &here)
            && a.across * b.across < 0.0
        {
            let grows = (b.across > a.across) == (speed > *slower);
            let at = |speed: f64| {
                Ok(balanced(averaged, place, speed, a.lead)?.map(|balanced| (balanced.across, balanced)))
            };
            let close = |off: f64, _: &Balanced| off < CLOSE * speed.abs();
            let root = root((*slower, a.across), (speed, b.across, *b), at, close)?;
            found.extend(root.map(|(speed, there)| Crossing {
                speed,
                lead: there.lead,
                along: there.along,
                grows,
            }));
        }
        before = here.map(|here| (speed, here));
    }
    Ok(found)
}

/// A place and whirl speed at which no moment acts.
#[derive(Clone, Copy)]
struct Balanced {
    lead: f64,
    /// Accelerations along the eccentricity, less that of the circular motion, and across, m/s^2.
    along: f64,
    across: f64,
}

/// The lead at which no moment acts, from near another one; `None` where forces have no value, or no lead has.
fn balanced(averaged: &mut Averaged, place: f64, speed: f64, near: f64) -> Result<Option<Balanced>> {
    let mut at = |lead: f64| match averaged.residual(&[place, speed, lead]) {
        Ok(residual) => Ok(Some([residual[0], residual[1], residual[2]])),
        Err(e) if e.is_stop() => Err(e),
        Err(_) => Ok(None),
    };
    let end = |lead: f64, [along, across, _]: [f64; 3]| Some(Balanced { lead, along, across });
    let Some(mut low) = at(near)? else { return Ok(None) };
    if low[2] == 0.0 {
        return Ok(end(near, low));
    }
    // The moment grows with the lead.
    let (away, mut from, mut step) = (-low[2].signum(), near, FIRST_LEAD);
    let (to, high) = loop {
        let to = from + away * step;
        let Some(there) = at(to)? else { return Ok(None) };
        if there[2] * low[2] <= 0.0 {
            break (to, there);
        }
        (from, low) = (to, there);
        step *= LEAD_GROWTH;
        if step > FARTHEST_LEAD {
            return Ok(None);
        }
    };
    let flat = |_: f64, there: &[f64; 3]| {
        let [along, across, moment] = there.map(f64::abs);
        moment <= BESIDE_ACROSS * across + BESIDE_ALONG * along
    };
    let root =
        root((from, low[2]), (to, high[2], high), |lead| Ok(at(lead)?.map(|there| (there[2], there))), flat)?;
    Ok(root.and_then(|(lead, there)| end(lead, there)))
}

/// Where what `at` gives first changes its sign between a and b (place, value, and at b all that belongs to it), by the method of
/// Anderson and Bjorck; `close` tells from the width of the bracket and from what belongs to a place whether that is close enough. `None`
/// where there is no value on the way.
fn root<T>(
    (mut a, mut at_a): (f64, f64),
    (mut b, mut at_b, mut there): (f64, f64, T),
    mut at: impl FnMut(f64) -> Result<Option<(f64, T)>>,
    close: impl Fn(f64, &T) -> bool,
) -> Result<Option<(f64, T)>> {
    for _ in 0..MOST_STEPS {
        if at_b == 0.0 || close((b - a).abs(), &there) {
            break;
        }
        let middle = b - at_b * (b - a) / (at_b - at_a);
        let Some((value, found)) = at(middle)? else { return Ok(None) };
        if value * at_b < 0.0 {
            (a, at_a) = (b, at_b);
        } else {
            // The end that stays counts less, so that it does not stay.
            let share = 1.0 - value / at_b;
            at_a *= if share > 0.0 { share } else { 0.5 };
        }
        (b, at_b, there) = (middle, value, found);
    }
    Ok(Some((b, there)))
}
