//! Derivatives of the wrenches of contacts over the coordinates of their bodies, for every pair, in lanes.
//!
//! A contact knows nothing but the motion of its element as it is seen from its mate: place, velocity and spin, five numbers. A
//! pair gives how its contacts vary with these ([`Kinematics`]); the rest is the same for all. With k x (a, b) = (-b, a), vectors
//! in the axes of the element:
//!
//! ```text
//! s = place of the element less that of the mate,   w = s_dot - omega k x s,   sigma = w_b - omega
//! xi = ds - dtheta k x s,   eta = dw - dtheta k x w                             as they are seen from the mate
//! dF = F_xi xi + F_eta eta + F_sigma dsigma + dtheta k x F                      force on the element
//! dM = M_xi xi + M_eta eta + M_sigma dsigma                                     its moment
//! on the mate: force -F, moment -M - s x F
//! ```

use super::law_slopes::{DIRECTIONS, EDGE_SHARE, FORCES, LawSlopes, VISCOSITY, contact_force};
use super::{Batch, ContactBlock};
use crate::bodies::{CAGE, ElementMotion, Motions};
use crate::laws::contact_pair::ContactMotion;
use crate::pairs::slope_sums::{ContactColumns, OverSpinAngles, SlopeSums};
use crate::pairs::{ElementPair, Grip};
use crate::scalar::{Base, Columns, Duals, Lanes, Numeric, Pack, ZEROS, dispatch, one_by_one, place_of};
use crate::space::{Frame, Motion};
use pulp::Simd;
use std::ops::Range;

/// Directions: place of the element beside the mate (along the radius, across), velocity there, spin.
const RELATIVE: usize = 5;
/// A number with its derivatives over the five numbers.
pub(in crate::pairs) type Varied<B> = Duals<RELATIVE, B>;

/// Elements and their mate, each element by its own axes.
pub(in crate::pairs) struct Beside<B> {
    pub(in crate::pairs) element: ElementMotion<B>,
    /// r, m.
    pub(in crate::pairs) radius: B,
    /// Angle travelled since the start, rad.
    pub(in crate::pairs) travel: B,
    /// Which contact of the pair it is.
    pub(in crate::pairs) contact: B,
    pub(in crate::pairs) mate: Motion<B>,
    /// How a deformed mate displaces its places for the elements, and how fast: outwards and counter-clockwise, m and m/s.
    pub(in crate::pairs) displacement: Option<[[B; 2]; 2]>,
    /// Slope and curvature of waves of the mate and of the element, m/rad and m/rad^2: see [`Kinematics::waves`].
    pub(in crate::pairs) waves: Option<[[B; 2]; 2]>,
}

impl<B: Base> Beside<B> {
    /// s: place of the element less that of the mate, m.
    #[inline(always)]
    fn place(&self) -> [B; 2] {
        [self.radius - self.mate.position[0], -self.mate.position[1]]
    }
}

/// Contacts that vary with what they know.
pub(in crate::pairs) struct VariedContact<B> {
    pub(in crate::pairs) motion: ContactMotion<Varied<B>>,
    /// Share of edge friction, where there are edges.
    pub(in crate::pairs) edge_share: Option<Varied<B>>,
    /// How they change with the spin angle of the element, where it counts.
    pub(in crate::pairs) over_spin_angle: Option<OverSpinAngle<B>>,
    pub(in crate::pairs) grip: Grip<Varied<B>>,
}

/// Derivatives of a contact over the spin angle of its element: of approach and its rate, normal and offset.
pub(in crate::pairs) struct OverSpinAngle<B> {
    pub(in crate::pairs) delta: B,
    pub(in crate::pairs) delta_dot: B,
    pub(in crate::pairs) normal: [B; 2],
    pub(in crate::pairs) offset: B,
}

/// How the contacts of a pair vary.
pub(in crate::pairs) trait Kinematics: ElementPair {
    /// Slopes and curvatures of waves of the mate and of element `j` where they touch, m/rad and m/rad^2; `None` where both are round.
    fn waves(&self, _motions: &Motions, _j: usize) -> Option<[[f64; 2]; 2]> {
        None
    }

    /// The contacts of these elements. Must be inlined with all that it calls.
    fn contact<B: Base>(&self, at: &Beside<B>) -> VariedContact<B>;
}

/// Memory for the contacts of a group.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub(crate) struct RelativeSlopes {
    element: [Lanes; 5],
    travel: Lanes,
    contact: Lanes,
    displaced: [[Lanes; 2]; 2],
    waves: [[Lanes; 2]; 2],
    columns: ContactColumns,
    over_spin_angle: OverSpinAngles,
}

impl RelativeSlopes {
    pub(crate) fn new() -> Self {
        Self {
            element: [ZEROS; 5],
            travel: ZEROS,
            contact: ZEROS,
            displaced: [[ZEROS; 2]; 2],
            waves: [[ZEROS; 2]; 2],
            columns: ContactColumns::ZERO,
            over_spin_angle: OverSpinAngles::ZERO,
        }
    }
}

/// Adds the derivatives of the wrenches of these contacts of a batch, which are those of one pair.
pub(in crate::pairs) fn add_slopes<P: Kinematics>(
    pair: &P,
    batch: &Batch,
    contacts: Range<usize>,
    motions: &Motions,
    sums: &mut SlopeSums<'_>,
    memory: &mut RelativeSlopes,
) {
    if contacts.is_empty() {
        return;
    }
    // Groups are never wider than this and begin at multiples of their width.
    let first = contacts.start / ALIGNED * ALIGNED;
    let mate = pair.info().mate;
    let speeding = sums.speeding(mate);
    let warming = sums.ln_viscosity_rate;
    let moving = sums.moving(mate) != [[0.0; 2]; 2];
    let turning = sums.rates.angles.get(mate).copied().filter(|_| pair.waves(motions, 0).is_some());
    let changing = speeding != 0.0 || warming != 0.0 || moving || turning.is_some() || sums.layout.count == 0;
    let holds = sums.layout.shared(mate).is_some();
    let deforms = mate == CAGE && !motions.displaced.is_empty();
    macro_rules! work {
        ($wavy:literal) => {
            Chain::<P, $wavy> {
                pair,
                batch,
                slopes: &batch.slopes,
                contacts,
                first,
                mate,
                holds,
                deforms,
                motions,
                speeding,
                warming,
                turning: turning.unwrap_or(0.0),
                changing,
                sums,
                memory,
            }
        };
    }
    match turning {
        None => dispatch(motions.instructions, work!(false)),
        Some(_) => one_by_one(work!(true)),
    }
}

/// Largest number of numbers in one register.
const ALIGNED: usize = 8;

/// Contacts of a pair, of bodies with waves or of round ones.
struct Chain<'a, 'b, P, const WAVY: bool> {
    pair: &'a P,
    batch: &'a Batch,
    slopes: &'a LawSlopes,
    contacts: Range<usize>,
    first: usize,
    mate: usize,
    /// Whether the mate is free.
    holds: bool,
    /// Whether the mate displaces its places for the elements.
    deforms: bool,
    motions: &'a Motions,
    /// Rate of the speed of the mate, rad/s^2, and of the logarithm of the viscosity, 1/s.
    speeding: f64,
    warming: f64,
    /// Rate of the angle of a mate with waves, rad/s.
    turning: f64,
    /// Whether anything changes while the state does not.
    changing: bool,
    sums: &'a mut SlopeSums<'b>,
    memory: &'a mut RelativeSlopes,
}

impl<P: Kinematics, const WAVY: bool> Columns for Chain<'_, '_, P, WAVY> {
    /// Values with their derivatives fill the registers by themselves.
    const PAIRED: bool = false;

    fn rows(&self) -> usize {
        self.contacts.end - self.first
    }

    #[inline(always)]
    fn group<S: Simd, const K: usize>(&mut self, simd: S, first: usize) {
        let first = first + self.first;
        let here = first.max(self.contacts.start)..(first + K * S::F64_LANES).min(self.contacts.end);
        if here.is_empty() {
            return;
        }
        self.gather(here.clone());
        self.differentiate::<S, K>(simd, first);
        let (sums, columns) = (&mut *self.sums, &self.memory.columns);
        for i in here.clone() {
            let (_, lane) = place_of(i);
            sums.add_contact(self.batch.sites[i].element, self.mate, columns, lane);
        }
        let ((_, lane), count) = (place_of(here.start), here.len());
        sums.add_on_mate(self.mate, columns, lane..lane + count);
        if self.deforms {
            for i in here.clone() {
                let (block, lane) = self.batch.at(i);
                let [y, z, _] = &block.on_mates;
                let j = self.batch.sites[i].element;
                sums.add_displaced(j, self.mate, [y[lane], z[lane]], self.motions, columns, lane);
            }
        }
        if WAVY {
            for i in here.clone() {
                let (_, lane) = place_of(i);
                let over = &self.memory.over_spin_angle;
                sums.add_over_spin_angle(self.batch.sites[i].element, self.mate, over, lane);
            }
        }
        if self.changing {
            for i in here {
                let (_, lane) = place_of(i);
                sums.add_contact_over_time(self.batch.sites[i].element, self.mate, columns, lane);
            }
        }
    }
}

impl<P: Kinematics, const WAVY: bool> Chain<'_, '_, P, WAVY> {
    /// Brings the elements of contacts to the places of these.
    #[inline(always)]
    fn gather(&mut self, contacts: Range<usize>) {
        let RelativeSlopes { element, travel, contact, displaced, waves, .. } = &mut *self.memory;
        for i in contacts {
            let site = &self.batch.sites[i];
            let ((block, from), (_, lane)) = (place_of(site.element), place_of(i));
            let m = &self.motions.blocks[block].motion;
            element[0][lane] = m.radial_offset[from];
            element[1][lane] = m.radial_speed[from];
            element[2][lane] = m.orbit_speed[from];
            element[3][lane] = m.spin_speed[from];
            element[4][lane] = m.radius_excess[from];
            travel[lane] = self.motions.travel(site.element);
            if self.deforms {
                let displacement = self.motions.displacement(site.element);
                for (part, now) in displaced.iter_mut().zip(displacement) {
                    part.iter_mut().zip(now).for_each(|(column, x)| column[lane] = x);
                }
            }
            contact[lane] = site.contact as f64;
            if WAVY {
                let here = self.pair.waves(self.motions, site.element).unwrap_or_default();
                let columns = waves.as_flattened_mut().iter_mut();
                columns.zip(here.as_flattened()).for_each(|(column, x)| column[lane] = *x);
            }
        }
    }

    /// Fills the columns of the group of contacts from this one on.
    #[inline(always)]
    fn differentiate<S: Simd, const K: usize>(&mut self, simd: S, first: usize) {
        let (block, lane) = place_of(first);
        let ContactBlock { frame, force, .. } = &self.batch.blocks[block];
        let load = |column: &Lanes| Pack::<S, K>::load(simd, &column[lane..]);
        let all = |x: f64| Pack::<S, K>::all(simd, x);
        let frame = frame.load::<S, K>(simd, lane);
        let [offset, radial_speed, orbit_speed, spin_speed, radius_excess] = &self.memory.element;
        let element = ElementMotion {
            radial_offset: load(offset),
            radial_speed: load(radial_speed),
            orbit_speed: load(orbit_speed),
            spin_speed: load(spin_speed),
            radius_excess: load(radius_excess),
        };
        let mate = &self.motions.shared[self.mate];
        let mate = Motion {
            position: frame.to_local([all(mate.position[0]), all(mate.position[1])]),
            velocity: frame.to_local([all(mate.velocity[0]), all(mate.velocity[1])]),
            angle: all(mate.angle),
            speed: all(mate.speed),
        };
        let (travel, contact) = (load(&self.memory.travel), load(&self.memory.contact));
        let radius = element.radial_offset + self.motions.pitch_radius();
        let displaced = &self.memory.displaced;
        let displacement = self.deforms.then(|| {
            let [[outwards, ahead], [outwards_rate, ahead_rate]] = displaced;
            [[load(outwards), load(ahead)], [load(outwards_rate), load(ahead_rate)]]
        });
        let [[a, b], [c, d]] = &self.memory.waves;
        let waves = if WAVY { Some([[load(a), load(b)], [load(c), load(d)]]) } else { None };
        let at = Beside { element, radius, travel, contact, mate, displacement, waves };
        let VariedContact { motion, edge_share, over_spin_angle, grip } = self.pair.contact(&at);

        let zero = all(0.0);
        let slopes = self.slopes.block(block);
        let values = [load(&force.normal), load(&force.friction), load(&force.rolling_resistance)];
        let mut forces = [Varied { re: zero, eps: [zero; RELATIVE] }; FORCES];
        let mut warm = [zero; FORCES];
        for f in 0..FORCES {
            let slope: [Pack<S, K>; DIRECTIONS] = [
                load(&slopes[f][0]),
                load(&slopes[f][1]),
                load(&slopes[f][2]),
                load(&slopes[f][3]),
                load(&slopes[f][EDGE_SHARE]),
                load(&slopes[f][VISCOSITY]),
            ];
            forces[f].re = values[f];
            for d in 0..RELATIVE {
                let mut sum = slope[0] * motion.delta.eps[d] + slope[1] * motion.delta_dot.eps[d];
                sum += slope[2] * motion.u1.eps[d] + slope[3] * motion.u2.eps[d];
                if let Some(share) = &edge_share {
                    sum += slope[EDGE_SHARE] * share.eps[d];
                }
                forces[f].eps[d] = sum;
            }
            warm[f] = slope[VISCOSITY] * self.warming;
        }
        let own = on_element(&grip, forces);
        let still = Grip {
            normal: [grip.normal[0].re, grip.normal[1].re],
            arm: grip.arm.re,
            offset: grip.offset.re,
            rolling: grip.rolling.re,
            on_mate: [zero; 3],
        };
        let warming = on_element(&still, warm);
        let columns = &mut self.memory.columns;
        let mut turning = None;
        if let Some(over) = &over_spin_angle {
            let mut rates = [Duals::<1, _> { re: zero, eps: [zero] }; FORCES];
            for f in 0..FORCES {
                let by = load(&slopes[f][0]) * over.delta + load(&slopes[f][1]) * over.delta_dot;
                rates[f] = Duals { re: values[f], eps: [by] };
            }
            let lift = |re| Duals { re, eps: [zero] };
            let turned = Grip {
                normal: [
                    Duals { re: still.normal[0], eps: [over.normal[0]] },
                    Duals { re: still.normal[1], eps: [over.normal[1]] },
                ],
                arm: lift(still.arm),
                offset: Duals { re: still.offset, eps: [over.offset] },
                rolling: lift(still.rolling),
                on_mate: [lift(zero); 3],
            };
            let [radial, across, moment] = on_element(&turned, rates);
            let by = [radial.eps[0], across.eps[0], moment.eps[0]];
            store_over_spin_angle(&at, frame, by, &mut self.memory.over_spin_angle, lane);
            turning = Some((by, self.turning));
        }
        let by = chain(&at, frame, &own, (&warming, self.speeding, turning), columns, lane);
        if self.holds {
            on_mate(&at, frame, [own[0].re, own[1].re], by, columns, lane);
        }
    }
}

/// The wrench on elements with this normal force, friction and rolling resistance, N, or with their rates.
#[inline(always)]
fn on_element<T: Numeric>(grip: &Grip<T>, forces: [T; FORCES]) -> [T; 3] {
    let [on_element, _] = grip.wrenches(&contact_force(forces));
    on_element.components()
}

/// Derivatives of a wrench over the coordinates of element and mate, which are seen in the axes of the element, and over time.
type Rows<S, const K: usize> = [[Pack<S, K>; 3]; ContactColumns::COUNT];
/// Derivatives over the spin angles of elements, and the rate of the angle of their mate, rad/s.
type Turned<S, const K: usize> = ([Pack<S, K>; 3], f64);
/// Columns of the radial offset, and of the place of the mate.
const OFFSET: usize = ContactColumns::OFFSET;
const PLACE: usize = ContactColumns::PLACE;
/// Of the travel and the angle of the mate: axes turn with them.
const TRAVEL: usize = OFFSET + 1;
const ANGLE: usize = PLACE + 2;
/// Of speeds.
const RADIAL_SPEED: usize = ContactColumns::RADIAL_SPEED;
const VELOCITY: usize = ContactColumns::VELOCITY;

/// Keeps the derivatives of the wrench on elements over their spin angles, in their axes, and what they make of that on the mate.
#[inline(always)]
fn store_over_spin_angle<S: Simd, const K: usize>(
    at: &Beside<Pack<S, K>>,
    frame: Frame<Pack<S, K>>,
    [radial, across, moment]: [Pack<S, K>; 3],
    out: &mut OverSpinAngles,
    lane: usize,
) {
    let s = at.place();
    let [y, z] = frame.to_global([radial, across]);
    radial.store(&mut out.own[0][lane..]);
    across.store(&mut out.own[1][lane..]);
    moment.store(&mut out.own[2][lane..]);
    (-y).store(&mut out.on_mate[0][lane..]);
    (-z).store(&mut out.on_mate[1][lane..]);
    (s[1] * radial - s[0] * across - moment).store(&mut out.on_mate[2][lane..]);
}

/// From derivatives over the five numbers to those over the coordinates of element and mate, of the wrench on elements, `own`,
/// which changes at the rate `warming` by itself, with the speed of the mate at the rate `speeding`, and where there are waves with its angle:
/// derivatives over the spin angles, and the rate of the angle of the mate. Returns those in axes that do not turn with the element.
#[inline(always)]
fn chain<S: Simd, const K: usize>(
    at: &Beside<Pack<S, K>>,
    frame: Frame<Pack<S, K>>,
    own: &[Varied<Pack<S, K>>; 3],
    (warming, speeding, turned): (&[Pack<S, K>; 3], f64, Option<Turned<S, K>>),
    out: &mut ContactColumns,
    lane: usize,
) -> Rows<S, K> {
    let (m, r, mate) = (&at.element, at.radius, &at.mate);
    let turning = mate.speed;
    let velocity = [m.radial_speed, r * m.orbit_speed];
    let s = at.place();
    let w =
        [velocity[0] - mate.velocity[0] + turning * s[1], velocity[1] - mate.velocity[1] - turning * s[0]];
    let mut by = [[turning; 3]; ContactColumns::COUNT];
    for i in 0..3 {
        let [x, y, v, u, spin] = own[i].eps;
        let over_speed = s[1] * v - s[0] * u - spin;
        by[OFFSET][i] = x + (m.orbit_speed - turning) * u;
        by[TRAVEL][i] = r * y + (turning * r - velocity[1]) * v + velocity[0] * u;
        by[RADIAL_SPEED][i] = v;
        by[RADIAL_SPEED + 1][i] = r * u;
        by[RADIAL_SPEED + 2][i] = spin;
        by[PLACE][i] = turning * u - x;
        by[PLACE + 1][i] = -(turning * v + y);
        by[ANGLE][i] = s[1] * x - s[0] * y + w[1] * v - w[0] * u;
        by[VELOCITY][i] = -v;
        by[VELOCITY + 1][i] = -u;
        by[VELOCITY + 2][i] = over_speed;
        by[ContactColumns::TIME][i] = warming[i] + over_speed * speeding;
    }
    by[ANGLE][0] -= own[1].re;
    by[ANGLE][1] += own[0].re;
    if let Some((over_spin_angle, rate)) = turned {
        // The axes of the mate turn without the element.
        for i in 0..3 {
            by[ContactColumns::TIME][i] += (by[ANGLE][i] - over_spin_angle[i]) * rate;
        }
    }
    let mut seen = by;
    // The axes of the element turn with its travel.
    seen[TRAVEL][0] += own[1].re;
    seen[TRAVEL][1] -= own[0].re;
    store(seen, frame, &mut out.own, lane);
    by
}

/// Those of the wrench on the mate: force -F, moment -M - s x F.
#[inline(always)]
#[expect(clippy::needless_range_loop, reason = "iterators might not be inlined")]
fn on_mate<S: Simd, const K: usize>(
    at: &Beside<Pack<S, K>>,
    frame: Frame<Pack<S, K>>,
    force: [Pack<S, K>; 2],
    mut by: Rows<S, K>,
    out: &mut ContactColumns,
    lane: usize,
) {
    let s = at.place();
    for c in 0..ContactColumns::COUNT {
        let [radial, across, moment] = by[c];
        let [y, z] = frame.to_global([radial, across]);
        by[c] = [-y, -z, s[1] * radial - s[0] * across - moment];
    }
    // s changes with the places of both.
    by[OFFSET][2] -= force[1];
    by[TRAVEL][2] += at.radius * force[0];
    by[PLACE][2] += force[1];
    by[PLACE + 1][2] -= force[0];
    store(by, frame, &mut out.on_mate, lane);
}

/// Keeps columns, place and velocity of the mate in global axes.
#[inline(always)]
#[expect(clippy::needless_range_loop, reason = "iterators might not be inlined")]
fn store<S: Simd, const K: usize>(
    mut by: Rows<S, K>,
    frame: Frame<Pack<S, K>>,
    out: &mut [[Lanes; 3]; ContactColumns::COUNT],
    lane: usize,
) {
    for c in [PLACE, VELOCITY] {
        for i in 0..3 {
            [by[c][i], by[c + 1][i]] = frame.to_global([by[c][i], by[c + 1][i]]);
        }
    }
    for c in 0..ContactColumns::COUNT {
        for i in 0..3 {
            by[c][i].store(&mut out[c][i][lane..]);
        }
    }
}
