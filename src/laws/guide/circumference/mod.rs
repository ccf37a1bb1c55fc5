//! Force of a film around the whole circumference, with its derivatives.
//!
//! The circle is walked in stretches: breaks are found, wet pieces between them integrated. Derivatives are those of the
//! integral over the motion in axes of the eccentricity, and these turn with the journal: what the angle of the lobes does
//! is what turning everything else the other way does, and the force with it.

pub(super) mod breaks;
pub(super) mod gap;
pub(super) mod land;
pub(super) mod panels;
mod roots;
mod round;
pub(super) mod rule;
pub(super) mod samples;
pub(super) mod stretch;

use crate::laws::fluid::grease::Thickening;
use crate::laws::guide::journal::{FilmForce, Harmonic, JournalMotion, NoFilm};
use crate::scalar::{Real, ZEROS, math};
use breaks::Search;
use gap::{Gap, Lobe};
use land::{Land, OUTPUTS, VARIABLES, VELOCITIES};
use panels::{PanelSums, Panels, Sums, totals};
use pulp::Arch;
use samples::{Memory, with_memory};
use std::f64::consts::{PI, TAU};
use stretch::{Aims, Break, DRY, EXCESS, FUNCTIONS, OPENING, Stretch};

/// Most lobes of a gap; there is room for a few of them at no cost.
const MOST_LOBES: usize = 64;
const FEW_LOBES: usize = 8;

/// Room for the lobes of a gap.
struct Room {
    few: [Lobe; FEW_LOBES],
    many: Option<[Lobe; MOST_LOBES]>,
}

impl Room {
    fn new() -> Self {
        Self { few: [Lobe::default(); FEW_LOBES], many: None }
    }

    /// Lobes of a profile that is turned by `angle` (rad), seen from this direction.
    fn lobes(&mut self, roundness: &[Harmonic], [cos, sin]: [f64; 2], angle: f64) -> &[Lobe] {
        let room = if roundness.len() <= FEW_LOBES {
            &mut self.few[..]
        } else {
            &mut self.many.insert([Lobe::default(); MOST_LOBES])[..]
        };
        if roundness.is_empty() {
            return &[];
        }
        let turned = math::atan2(sin, cos) - angle;
        let count = roundness.len().min(room.len());
        for (lobe, harmonic) in room.iter_mut().zip(roundness) {
            *lobe = Lobe::of(harmonic, turned);
        }
        &room[..count]
    }
}

/// A film between journal and bush.
pub(in crate::laws::guide) struct Film<'a> {
    pub land: Land,
    /// C, m.
    pub clearance: f64,
    /// h_L, m; infinite for a clearance full of oil.
    pub layer: f64,
    /// Whether the jump of the pressure at the ends of wet arcs is left out of the shear.
    pub within_arc: bool,
    /// Whether dh/dt is included.
    pub squeezed: bool,
    /// Whether its drag pushes the surfaces, or turns them only.
    pub drags: bool,
    pub roundness: &'a [Harmonic],
    pub instructions: Arch,
}

impl Film<'_> {
    /// Force on the journal.
    ///
    /// # Errors
    /// [`NoFilm`] where h <= 0.
    pub fn force<T: Real>(&self, m: &JournalMotion<T>) -> Result<FilmForce<T>, NoFilm> {
        let motion = m.value();
        let (e, direction) = eccentricity(motion.position);
        let round = self.roundness.is_empty();
        let thinnest = self.clearance - e;
        // Written so that a NaN counts as no film.
        let exists = thinnest > 0.0 || (!round && e.is_finite());
        if !exists {
            return Err(NoFilm { minimum_film: thinnest });
        }
        // Lobes cannot reach further than all of them together.
        let reach: f64 = self.roundness.iter().map(|harmonic| harmonic.amplitude.abs()).sum();
        if thinnest - reach >= self.layer {
            return Ok(FilmForce::none());
        }
        let mut room = Room::new();
        let lobes = room.lobes(self.roundness, direction, motion.profile_angle);
        let mut gap = Gap::new([self.land.radius, self.clearance], &motion, e, direction, lobes);
        if !self.squeezed {
            gap.squeeze = 0.0;
        }
        if !self.drags {
            gap.drift = 0.0;
        }
        let gap = gap;
        let mut rows;
        let slopes = match derivatives(m) {
            0 => &mut [][..],
            count => {
                rows = [[ZEROS; OUTPUTS]; VARIABLES];
                &mut rows[..count]
            }
        };
        let [height, largest_opening] = gap.bounds();
        let sums = Sums { land: self.land, values: [ZEROS; OUTPUTS], slopes };
        let instructions = self.instructions;
        let jumps = self.within_arc;
        let mut panels = Panels::new(self.land, &gap, largest_opening, jumps, instructions, sums);
        self.integrate(&mut panels, height)?;
        Ok(self.lifted(&gap, direction, m, &panels.sums))
    }

    /// Smallest thickness, m.
    pub fn minimum(&self, m: &JournalMotion<f64>) -> f64 {
        let (e, direction) = eccentricity(m.position);
        if self.roundness.is_empty() || !e.is_finite() {
            return self.clearance - e;
        }
        let mut room = Room::new();
        let lobes = room.lobes(self.roundness, direction, m.profile_angle);
        let gap = Gap::new([self.land.radius, self.clearance], m, e, direction, lobes);
        gap.smallest(self.instructions)[0]
    }

    /// Sums over the circle. Lobes have this height, m.
    fn integrate<S: PanelSums>(&self, panels: &mut Panels<'_, S>, height: f64) -> Result<(), NoFilm> {
        let Panels { gap, largest_opening, .. } = *panels;
        let excess = self.excess(gap.thinnest - height, largest_opening);
        let aims = excess.map_or(Aims::Edges, Aims::EdgesAndExcess);
        if aims == Aims::Edges && gap.is_round() {
            let circle = round::circle(gap, self.layer);
            let mut walk = Walk::from(-PI);
            walk.pass(self, panels, circle.negative, circle.breaks.all());
            walk.end(self, panels, PI);
            return Ok(());
        }
        with_memory(gap.order(), |memory| self.integrate_with(panels, aims, memory)).map(|_| ())
    }

    /// Sums over the circle with these breaks; what no film is less than but by the curvature within half a step, m, of bent
    /// surfaces only.
    pub fn integrate_with<S: PanelSums>(
        &self,
        panels: &mut Panels<'_, S>,
        aims: Aims,
        memory: Memory<'_>,
    ) -> Result<f64, NoFilm> {
        let mut search = Search::new(panels.gap, self.layer, aims, panels.instructions, memory);
        let (mut stretch, mut walk) = (Stretch::new(), Walk::from_first_break());
        while search.next(&mut stretch) {
            // Written so that a NaN counts as no film.
            let exists = stretch.thinnest > 0.0;
            if !exists {
                return Err(NoFilm { minimum_film: stretch.thinnest });
            }
            walk.pass(self, panels, stretch.negative, stretch.breaks.all());
        }
        walk.end(self, panels, stretch.to);
        Ok(if panels.gap.harmonics.is_empty() { stretch.thinnest } else { search.lowest() })
    }

    /// Whether the film does something where the functions of the breaks have these signs.
    fn acts(&self, negative: [bool; FUNCTIONS]) -> bool {
        negative[DRY] && (negative[OPENING] || self.land.drag != 0.0)
    }

    /// c of K = G + c h^3, if s_cap may be reached in a film that is nowhere thinner than this, m.
    pub fn excess(&self, thinnest: f64, largest_opening: f64) -> Option<f64> {
        let land = &self.land;
        let scale = land.peak_scale * land.barus.pressure_viscosity;
        let thickest = land.thickening.as_ref().map_or(1.0, Thickening::largest);
        let below = scale * thickest * largest_opening < land.barus.cap * thinnest.max(0.0).powi(3);
        (!below).then(|| land.barus.cap / scale)
    }

    /// Force and moment with the derivatives that the motion asks for.
    fn lifted<T: Real>(
        &self,
        gap: &Gap<'_>,
        [cos, sin]: [f64; 2],
        m: &JournalMotion<T>,
        sums: &Sums<'_>,
    ) -> FilmForce<T> {
        let turn = |[a, b]: [T; 2]| [a * cos - b * sin, b * cos + a * sin];
        let mut out = totals(&sums.values).map(T::constant);
        if T::DERIVATIVES {
            let along = |v: [T; 2]| {
                let [y, z] = v.map(change);
                [y * cos + z * sin, z * cos - y * sin]
            };
            let ([y, mut z], [mut vy, mut vz]) = (along(m.position), along(m.velocity));
            let turned = change(m.profile_angle);
            let (journal, bush) = (change(m.journal_speed), change(m.bush_speed));
            let lobed = !gap.lobes.is_empty();
            if lobed {
                let [v_1, v_2] = gap.velocity;
                z -= turned * gap.eccentricity;
                vy += turned * v_2;
                vz -= turned * v_1;
            }
            let rolling = (journal - bush) * self.land.radius;
            let changes = [vy, vz, journal + bush, rolling, change(m.profile_speed), y, z];
            for (change, row) in changes.into_iter().zip(&*sums.slopes) {
                for (out, slope) in out.iter_mut().zip(totals(row)) {
                    *out += change * slope;
                }
            }
            if lobed {
                for [a, b] in [[0, 1], [2, 3]] {
                    let (along, across) = (out[a].value(), out[b].value());
                    out[a] -= turned * across;
                    out[b] += turned * along;
                }
            }
        }
        let [p_1, p_2, s_1, s_2, moment]: [T; OUTPUTS] = out;
        let shear = if self.drags { turn([s_1, s_2]) } else { [T::constant(0.0); 2] };
        FilmForce { pressure: turn([p_1, p_2]), shear, moment }
    }
}

/// A way around the circle from break to break. Pieces go on where stretches end.
struct Walk {
    /// Where the present piece starts, rad; unknown before the first break if it starts there.
    from: Option<f64>,
    /// Where the circle ends that started at its first break, rad.
    end: Option<f64>,
    negative: [bool; FUNCTIONS],
}

impl Walk {
    /// From this angle on, rad.
    fn from(angle: f64) -> Self {
        Self { from: Some(angle), end: None, negative: [false; FUNCTIONS] }
    }

    /// From the first break on: no piece is cut but by breaks.
    fn from_first_break() -> Self {
        Self { from: None, end: None, negative: [false; FUNCTIONS] }
    }

    /// Passes a stretch with these breaks, at whose start functions are `negative`.
    fn pass<S: PanelSums>(
        &mut self,
        film: &Film<'_>,
        panels: &mut Panels<'_, S>,
        negative: [bool; FUNCTIONS],
        breaks: &[Break],
    ) {
        self.negative = negative;
        for b in breaks {
            match self.from {
                Some(from) => self.add_piece(film, panels, from, b.angle),
                None => self.end = Some(b.angle + TAU),
            }
            if b.of == DRY {
                panels.add_end(b.angle, if self.negative[DRY] { 1.0 } else { -1.0 });
            }
            self.negative[b.of] = !self.negative[b.of];
            self.from = Some(b.angle);
        }
    }

    /// Ends at this angle, rad, or where it started.
    fn end<S: PanelSums>(self, film: &Film<'_>, panels: &mut Panels<'_, S>, angle: f64) {
        let end = self.end.unwrap_or(angle);
        self.add_piece(film, panels, self.from.unwrap_or(end - TAU), end);
        panels.complete();
    }

    fn add_piece<S: PanelSums>(&self, film: &Film<'_>, panels: &mut Panels<'_, S>, from: f64, to: f64) {
        if film.acts(self.negative) {
            panels.add(from, to, self.negative[EXCESS]);
        }
    }
}

/// How a number changes: zero, with its derivatives.
fn change<T: Real>(x: T) -> T {
    x - x.value()
}

/// Number of variables that a motion asks for derivatives over.
fn derivatives<T: Real>(m: &JournalMotion<T>) -> usize {
    let [y, z] = m.position;
    match (T::DERIVATIVES, y.varies() || z.varies() || m.profile_angle.varies()) {
        (false, _) => 0,
        (true, false) => VELOCITIES,
        (true, true) => VARIABLES,
    }
}

/// Distance of the journal from the centre and its direction; the direction is arbitrary (+y) at the centre.
fn eccentricity([y, z]: [f64; 2]) -> (f64, [f64; 2]) {
    let r2 = y * y + z * z;
    // Below this, squares lose digits to underflow and the direction would not be a unit vector.
    if r2 < 1e-280 {
        return (0.0, [1.0, 0.0]);
    }
    let r = r2.sqrt();
    (r, [y / r, z / r])
}

#[cfg(test)]
mod tests;
