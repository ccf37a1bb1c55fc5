use super::*;
use crate::laws::elastic::solid::SolidContact;
use crate::laws::guide::journal::JournalMotion;
use crate::laws::guide::lubricant_layer::tests::layer;
use crate::laws::guide::short_bearing::ShortBearing;
use crate::laws::guide::{GuideSolid, LubricantLayer, PressureShear};
use crate::laws::traction::solid_friction::SolidFriction;
use crate::space::rotate;

const RADIUS: f64 = 46.6615e-3;
const CLEARANCE: f64 = 0.2135e-3;

/// A film without solid contact.
fn law(film: GuideFilm) -> GuideLaw {
    GuideLaw {
        radius: RADIUS,
        clearance: CLEARANCE,
        free_clearance: CLEARANCE,
        film: Some(film),
        solid: None,
        roughness: 0.0,
        touching_ratio: 0.0,
    }
}

fn films(on_journal: bool) -> Vec<GuideFilm> {
    let harmonics =
        |lobed: bool| if lobed { vec![Harmonic { order: 5, amplitude: 4e-6, phase: 0.7 }] } else { vec![] };
    let mut all = Vec::new();
    for lobed in [false, true] {
        for pressure_shear in [PressureShear::Absent, PressureShear::WithinArc, PressureShear::WithEdges] {
            all.push(GuideFilm::LubricantLayer(LubricantLayer {
                pressure_shear,
                roundness: harmonics(lobed),
                profile_on_journal: on_journal,
                ..layer()
            }));
        }
        all.push(GuideFilm::ShortBearing(ShortBearing {
            viscosity: 0.03,
            radius: RADIUS,
            clearance: CLEARANCE,
            land_width: 6e-3,
            squeeze: true,
            pressure_moment: true,
            roundness: harmonics(lobed),
            profile_on_journal: on_journal,
        }));
    }
    all
}

/// Fixed lobes of a film.
fn roundness(film: &GuideFilm) -> &[Harmonic] {
    match film {
        GuideFilm::ShortBearing(film) => &film.roundness,
        GuideFilm::LubricantLayer(film) => &film.roundness,
    }
}

fn surface(on_journal: bool) -> BentSurface {
    let waves = [(2, -0.45), (3, -0.24), (4, -0.12)].to_vec();
    BentSurface { waves, profile: Vec::new(), on_journal, growth: 0.0, contact_depth: 1e-6 }
}

struct State {
    position: [f64; 2],
    velocity: [f64; 2],
    speeds: [f64; 2],
    amplitudes: Vec<f64>,
    rates: Vec<f64>,
}

impl State {
    /// One of many, with waves of this size, m.
    fn random(rng: &mut fastrand::Rng, waves: f64) -> Self {
        let mut within = |x: f64| x * (2.0 * rng.f64() - 1.0);
        Self {
            position: [within(120e-6), within(120e-6)],
            velocity: [within(0.2), within(0.2)],
            speeds: [within(300.0), within(300.0)],
            amplitudes: (0..6).map(|_| within(waves)).collect(),
            rates: (0..6).map(|_| within(1e3 * waves)).collect(),
        }
    }

    fn motion(&self) -> BentMotion<'_> {
        BentMotion {
            position: self.position,
            velocity: self.velocity,
            speeds: self.speeds,
            amplitudes: &self.amplitudes,
            rates: &self.rates,
        }
    }

    /// Speed of every coordinate in axes of the cage; of the journal instead of the cage where there is the moment on it.
    fn powers(&self, forces: &[f64], s: f64) -> f64 {
        let [journal, bush] = if s > 0.0 { self.speeds } else { [self.speeds[1], self.speeds[0]] };
        let [fy, fz] = [s * forces[0], s * forces[1]];
        let [y, z] = self.position.map(|x| s * x);
        // The bush carries the moment of the force about its own centre.
        let on_bush = -(forces[2] + y * fz - z * fy);
        let of_waves: f64 = forces[OF_MOTION..].iter().zip(&self.rates).map(|(f, v)| f * v).sum();
        forces[0] * self.velocity[0]
            + forces[1] * self.velocity[1]
            + forces[2] * journal
            + on_bush * bush
            + of_waves
    }
}

fn forces(law: &GuideLaw, surface: &BentSurface, state: &State) -> Option<BentForces> {
    let profile = law.film.as_ref().map_or(&[][..], roundness).to_vec();
    let surface = BentSurface { profile, ..surface.clone() };
    let mut out = BentForces::new(&surface);
    law.bend(&surface, &state.motion(), Fluid::SAME, Wanted::Forces, &mut out).ok()?;
    Some(out)
}

#[test]
fn a_straight_surface_has_the_force_of_a_rigid_one() {
    let mut rng = fastrand::Rng::with_seed(5);
    for on_journal in [true, false] {
        for film in films(on_journal) {
            let (law, s) = (law(film), if on_journal { 1.0 } else { -1.0 });
            for _ in 0..60 {
                let state = State::random(&mut rng, 0.0);
                let [cage, ring] = state.speeds;
                let motion = JournalMotion {
                    position: state.position.map(|x| s * x),
                    velocity: state.velocity.map(|x| s * x),
                    journal_speed: if on_journal { cage } else { ring },
                    bush_speed: if on_journal { ring } else { cage },
                    profile_angle: 0.0,
                    profile_speed: cage,
                };
                let rigid = law.force(&motion, Fluid::SAME).unwrap();
                let bent = forces(&law, &surface(on_journal), &state).unwrap();
                let size = rigid.force()[0].hypot(rigid.force()[1]) + 1e-9;
                for k in 0..2 {
                    let error = (bent.parts.pressure[k] - rigid.pressure[k]).abs()
                        + (bent.parts.shear[k] - rigid.shear[k]).abs();
                    assert!(error < 2e-9 * size, "{:?} {:?} {rigid:?}", law.film, bent.parts);
                    assert!((bent.all[k] - s * rigid.force()[k]).abs() < 2e-9 * size);
                }
                let moment = (bent.all[2] - rigid.moment).abs();
                let allowed = 2e-9 * (size * RADIUS + rigid.moment.abs());
                assert!(moment <= allowed, "{:?}: {} {}", law.film, bent.all[2], rigid.moment);
            }
        }
    }
}

/// Forces by adding up many places.
fn by_hand(film: &Film<'_>, surface: &BentSurface, state: &State, profile: &[Harmonic]) -> Vec<f64> {
    let s = surface.sign();
    let [cage, ring] = state.speeds;
    let (n, mut out) = (400_000, vec![0.0; OF_MOTION + state.amplitudes.len()]);
    let Film { land, .. } = *film;
    let wave = |d: f64, [position, rates]: [&[f64; 2]; 2], waves: [&[f64]; 2]| -> [f64; 4] {
        let (sin, cos) = d.sin_cos();
        let mut sum = [
            position[0] * cos + position[1] * sin,
            -position[0] * sin + position[1] * cos,
            rates[0] * cos + rates[1] * sin,
            0.0,
        ];
        for (k, (order, along)) in surface.waves.iter().enumerate() {
            let (sin, cos) = (f64::from(*order) * d).sin_cos();
            let ([a, b], [a_rate, b_rate]) =
                ([waves[0][2 * k], waves[0][2 * k + 1]], [waves[1][2 * k], waves[1][2 * k + 1]]);
            let slope = f64::from(*order) * (b * cos - a * sin);
            sum[0] += a * cos + b * sin;
            sum[1] += slope;
            sum[2] += a_rate * cos + b_rate * sin - cage * slope;
            sum[3] += along * (a_rate * sin - b_rate * cos);
        }
        sum
    };
    for i in 0..n {
        let d = TAU * (f64::from(i) + 0.5) / f64::from(n);
        let (sin, cos) = d.sin_cos();
        let [w, slope, rate, along] =
            wave(d, [&state.position, &state.velocity], [&state.amplitudes, &state.rates]);
        let (mut h, mut h1, mut h_t, mut turned) = (CLEARANCE - s * w, -s * slope, -s * rate, 0.0);
        let (y, z) = (state.position[0], state.position[1]);
        turned += s * (slope - (z * cos - y * sin));
        for a in profile {
            let n = f64::from(a.order);
            let (sin, cos) = (n * d + a.phase).sin_cos();
            h -= a.amplitude * cos;
            h1 += n * a.amplitude * sin;
            h_t -= cage * n * a.amplitude * sin;
            turned -= n * a.amplitude * sin;
        }
        if h >= film.layer {
            continue;
        }
        let rolling = s * RADIUS * (cage - ring);
        let moving = s * (along - state.velocity[0] * sin + state.velocity[1] * cos);
        let sliding = if film.drags { rolling + moving } else { rolling };
        let place = crate::laws::guide::circumference::gap::Place {
            cos,
            sin,
            film: [h, h1, 0.0, 0.0],
            lobe_slope: 0.0,
            opening: [(cage + ring) * h1 + 2.0 * h_t, 0.0, 0.0, 0.0],
            sliding,
        };
        let (stress, _, _) = land.at(&place);
        let width = TAU / f64::from(n);
        let [n_, t, e] =
            [stress.normal, if film.drags { stress.along } else { 0.0 }, stress.inward].map(|x| x * width);
        out[0] += s * (-n_ * cos - t * sin - e * cos);
        out[1] += s * (-n_ * sin + t * cos - e * sin);
        out[2] += stress.moment * width + if surface.on_journal { n_ * turned } else { 0.0 };
        for (k, (order, along)) in surface.waves.iter().enumerate() {
            let order = f64::from(*order);
            let (sin, cos) = (order * d).sin_cos();
            out[OF_MOTION + 2 * k] += s * (-n_ * cos + t * along * sin + e * order * along * cos);
            out[OF_MOTION + 2 * k + 1] += s * (-n_ * sin - t * along * cos + e * order * along * sin);
        }
    }
    out
}

#[test]
fn bent_films_have_the_forces_of_their_definition() {
    let mut rng = fastrand::Rng::with_seed(6);
    for on_journal in [true, false] {
        for film in films(on_journal) {
            // The jump at the edges of arcs stands for itself.
            if matches!(&film, GuideFilm::LubricantLayer(l) if l.pressure_shear == PressureShear::WithinArc) {
                continue;
            }
            let (law, surface) = (law(film), surface(on_journal));
            for _ in 0..3 {
                let state = State::random(&mut rng, 15e-6);
                let found = forces(&law, &surface, &state).unwrap().all;
                let film = law.film.as_ref().unwrap();
                let expected = by_hand(&film.around(Fluid::SAME), &surface, &state, roundness(film));
                let size = expected.iter().fold(0.0f64, |size, f| size.max(f.abs()));
                for (k, (found, expected)) in found.iter().zip(&expected).enumerate() {
                    assert!(
                        (found - expected).abs() <= 5e-5 * size,
                        "{film:?} {k}: {found} {expected} of {size}"
                    );
                }
            }
        }
    }
}

#[test]
fn the_same_shape_has_the_same_force() {
    // Turning the axes of the waves by an angle and the cage back shows the same gap.
    let mut rng = fastrand::Rng::with_seed(7);
    let surface = surface(true);
    for pressure_shear in [PressureShear::WithinArc, PressureShear::WithEdges] {
        let law = law(GuideFilm::LubricantLayer(LubricantLayer { pressure_shear, ..layer() }));
        for _ in 0..50 {
            let state = State::random(&mut rng, 15e-6);
            let angle = 2.0 * rng.f64();
            let (sin, cos) = angle.sin_cos();
            let turn = |x: &[f64]| -> Vec<f64> {
                let waves = surface.waves.iter().zip(x.chunks(2));
                let turned = waves.flat_map(|((order, _), x)| {
                    let (sin, cos) = (f64::from(*order) * angle).sin_cos();
                    rotate([x[0], x[1]], -sin, cos)
                });
                turned.collect()
            };
            let turned = State {
                position: rotate(state.position, -sin, cos),
                velocity: rotate(state.velocity, -sin, cos),
                speeds: state.speeds,
                amplitudes: turn(&state.amplitudes),
                rates: turn(&state.rates),
            };
            let (a, b) =
                (forces(&law, &surface, &state).unwrap().all, forces(&law, &surface, &turned).unwrap().all);
            let size = a.iter().fold(0.0f64, |size, f| size.max(f.abs()));
            let [y, z] = rotate([b[0], b[1]], sin, cos);
            assert!((y - a[0]).abs() + (z - a[1]).abs() <= 1e-9 * size, "{a:?} {b:?}");
            assert!((a[2] - b[2]).abs() <= 1e-9 * size * RADIUS);
        }
    }
}

#[test]
fn bent_films_take_energy() {
    let mut rng = fastrand::Rng::with_seed(8);
    for on_journal in [true, false] {
        let s = if on_journal { 1.0 } else { -1.0 };
        for film in films(on_journal) {
            if film.passive().is_err() || matches!(film, GuideFilm::ShortBearing(_)) {
                continue;
            }
            let (law, surface) = (law(film), surface(on_journal));
            for _ in 0..500 {
                let state = State::random(&mut rng, 20e-6);
                let Some(found) = forces(&law, &surface, &state) else { continue };
                let power = state.powers(&found.all, s);
                let size: f64 = found.all.iter().map(|f| f.abs()).sum();
                assert!(power <= 1e-9 * size, "{:?}: {power} W", law.film);
            }
        }
    }
}

#[test]
fn pressure_on_a_lobe_turns_it_by_virtual_work() {
    // Frozen pressure does the work of the turning profile.
    let turn = 1e-6;
    for pressure_shear in [PressureShear::Absent, PressureShear::WithinArc, PressureShear::WithEdges] {
        let roundness = vec![
            Harmonic { order: 2, amplitude: 20e-6, phase: 0.4 },
            Harmonic { order: 5, amplitude: 6e-6, phase: 1.4 },
        ];
        let lobed = LubricantLayer { pressure_shear, roundness: roundness.clone(), ..layer() };
        let motion = JournalMotion {
            position: [130e-6, 60e-6],
            velocity: [-0.05, 0.1],
            journal_speed: 140.0,
            bush_speed: 0.0,
            profile_angle: 0.3,
            profile_speed: 140.0,
        };
        let moment = |lobed: &LubricantLayer| lobed.force(&motion, Fluid::SAME).unwrap().moment;
        // Without the pressure on the lobes: the same profile on the bush, but for what the gap makes of its turning.
        let with = moment(&lobed) - moment(&LubricantLayer { profile_on_journal: false, ..lobed.clone() });
        let film = lobed.around(Fluid::SAME);
        let (n, mut work) = (2_000_000, 0.0);
        let gap = |d: f64, angle: f64| {
            let mut h = CLEARANCE - motion.position[0] * d.cos() - motion.position[1] * d.sin();
            let (mut h1, mut h_t) = (
                motion.position[0] * d.sin() - motion.position[1] * d.cos(),
                -motion.velocity[0] * d.cos() - motion.velocity[1] * d.sin(),
            );
            for a in &roundness {
                let n = f64::from(a.order);
                let (sin, cos) = (n * (d - angle) + a.phase).sin_cos();
                h -= a.amplitude * cos;
                h1 += n * a.amplitude * sin;
                h_t -= motion.profile_speed * n * a.amplitude * sin;
            }
            [h, h1, h_t]
        };
        for i in 0..n {
            let d = TAU * (f64::from(i) + 0.5) / f64::from(n);
            let [h, h1, h_t] = gap(d, 0.3);
            if h < film.layer {
                let place = crate::laws::guide::circumference::gap::Place {
                    cos: d.cos(),
                    sin: d.sin(),
                    film: [h, h1, 0.0, 0.0],
                    lobe_slope: 0.0,
                    opening: [140.0 * h1 + 2.0 * h_t, 0.0, 0.0, 0.0],
                    sliding: 0.0,
                };
                let (stress, _, _) = film.land.at(&place);
                // The pressure pushes outwards on the bush, which a gap that opens lets it do.
                work += stress.normal * (gap(d, 0.3 + turn)[0] - h) * TAU / f64::from(n);
            }
        }
        let expected = work / turn;
        assert!((with / expected - 1.0).abs() < 5e-6, "{pressure_shear:?}: {with} {expected}");
        assert!(with.abs() > 1e-4);
    }
}

#[test]
fn arcs_narrower_than_a_step_are_found() {
    // Three lobes that reach the oil by less and less: each arc vanishes where its lobe leaves the layer.
    let law = law(GuideFilm::LubricantLayer(layer()));
    let surface = surface(true);
    let rest = CLEARANCE - 80e-6;
    for excess in [1e-5, 1e-6, 1e-8, 1e-10] {
        let mut state = State::random(&mut fastrand::Rng::with_seed(1), 0.0);
        (state.position, state.velocity) = ([0.0; 2], [0.0; 2]);
        state.speeds = [100.0, 0.0];
        state.amplitudes[2] = rest + excess;
        let (arcs, angle) = law.wet_arcs(&surface, &state.motion());
        // Half of an arc: a (1 - cos 3 d) = excess.
        let half = (1.0 - excess / (rest + excess)).acos() / 3.0;
        assert_eq!(arcs, 3, "{excess}");
        assert!((angle / (6.0 * half) - 1.0).abs() < 1e-6, "{angle} {half}");
        let found = forces(&law, &surface, &state).unwrap();
        assert!(found.all[2] < 0.0, "{:?}", found.all);
    }
}

#[test]
fn the_spread_solid_contact_is_continuous_and_conserves_energy() {
    let friction = Some(SolidFriction { coefficient: 0.1, transition_speed: 0.01 });
    let contact = SolidContact { stiffness: 1e6, damping: 0.0, softening_depth: 0.0, friction: None };
    let solid = |contact| GuideLaw {
        film: None,
        solid: Some(GuideSolid { contact, asperity_height: 0.0 }),
        ..law(GuideFilm::LubricantLayer(layer()))
    };
    let surface = surface(true);
    let mut state = State::random(&mut fastrand::Rng::with_seed(2), 0.0);
    state.velocity = [0.0; 2];
    // As stiff as the point contact at the depth that it was asked to be.
    state.position = [CLEARANCE + 1e-6, 0.0];
    let found = forces(&solid(contact), &surface, &state).unwrap();
    assert!((found.all[0] + 1.0).abs() < 5e-3, "{:?}", found.all);
    // Friction brakes.
    let rubbing = forces(&solid(SolidContact { friction, ..contact }), &surface, &state).unwrap();
    assert!(
        (rubbing.all[2] / (0.1 * RADIUS * found.all[0]).abs() + state.speeds[0].signum() * 1.0).abs() < 0.4
    );
    // Forces are the slope of an energy: second derivatives do not depend on their order.
    let mut rng = fastrand::Rng::with_seed(3);
    for _ in 0..20 {
        let mut state = State::random(&mut rng, 20e-6);
        (state.velocity, state.speeds) = ([0.0; 2], [0.0; 2]);
        state.rates.fill(0.0);
        state.position = [CLEARANCE * rng.f64(), CLEARANCE * rng.f64()];
        let mut out = BentForces::new(&surface);
        solid(contact).bend(&surface, &state.motion(), Fluid::SAME, Wanted::Slopes, &mut out).unwrap();
        let [k, _] = &out.over;
        let size = k.amax();
        for i in (0..k.nrows()).filter(|i| *i != 2) {
            for j in (0..i).filter(|j| *j != 2) {
                assert!((k[(i, j)] - k[(j, i)]).abs() <= 1e-9 * size, "{i} {j}: {} {}", k[(i, j)], k[(j, i)]);
            }
        }
    }
}
