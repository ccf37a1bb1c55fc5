//! Films take energy out of the motion of cage and ring, never put it in: at random states over all that is in use.

use crate::common::Random;
use cagedyn::laws::fluid::Fluid;
use cagedyn::laws::guide::journal::Harmonic;
use cagedyn::laws::guide::lubricant_layer::{LubricantLayer, PressureShear};
use cagedyn::laws::guide::short_bearing::ShortBearing;
use cagedyn::laws::guide::{GuideFilm, GuideLaw};
use cagedyn::pairs::guide::side::GuideSide;
use cagedyn::space::Motion;
use std::f64::consts::TAU;

const STATES: u32 = 100_000;

fn log(random: &mut Random, low: f64, high: f64) -> f64 {
    random.within(low.ln(), high.ln()).exp()
}

/// A film of any size on a cage that carries a profile now and then.
fn law(random: &mut Random, layered: bool, shear: PressureShear, side: GuideSide) -> GuideLaw {
    let (radius, width) = (log(random, 15e-3, 0.1), log(random, 2e-3, 20e-3));
    let clearance = radius * log(random, 1e-3, 5e-3);
    let profile_on_journal = side == GuideSide::CageInside;
    let roundness: Vec<Harmonic> = if random.chance(0.05) {
        let amplitude = log(random, 0.01, 0.3) * clearance;
        vec![Harmonic { order: 2 + random.index(5) as u32, amplitude, phase: random.within(0.0, TAU) }]
    } else {
        Vec::new()
    };
    let lobes: f64 = roundness.iter().map(|a| a.amplitude).sum();
    let viscosity = log(random, 1e-3, 0.3);
    let film = if layered {
        GuideFilm::LubricantLayer(LubricantLayer {
            viscosity,
            thickener: None,
            pressure_viscosity: if random.chance(0.2) { 0.0 } else { log(random, 5e-9, 3e-8) },
            cap: 0.9,
            radius,
            clearance,
            width,
            thickness: log(random, 0.1e-6, 200e-6),
            pressure_shear: shear,
            roundness,
            profile_on_journal,
        })
    } else {
        GuideFilm::ShortBearing(ShortBearing {
            viscosity,
            radius,
            clearance,
            land_width: width,
            squeeze: true,
            pressure_moment: shear == PressureShear::WithEdges,
            roundness,
            profile_on_journal,
        })
    };
    GuideLaw {
        radius,
        clearance,
        free_clearance: clearance - lobes,
        film: Some(film),
        solid: None,
        roughness: 0.0,
        touching_ratio: 0.0,
    }
}

/// Motion of cage and ring with a film between them: an outer ring at rest, or an inner one that turns about twice as fast as
/// the cage. Where both turn almost alike, the difference of their radii, which the films neglect, is no longer small.
fn motion(random: &mut Random, law: &GuideLaw, side: GuideSide) -> [Motion<f64>; 2] {
    let gap = log(random, 1e-4, 1.0);
    let e = law.free_clearance * (1.0 - gap);
    let direction = random.within(0.0, TAU);
    let mut sized = |low: f64, high: f64| {
        let size = log(random, low, high);
        if random.chance(0.5) { size } else { -size }
    };
    let mut body = |position: [f64; 2]| Motion {
        position,
        velocity: [sized(1e-5, 1.0), sized(1e-5, 1.0)],
        angle: sized(1e-3, 10.0),
        speed: sized(0.1, 1300.0),
    };
    let [cage, mut ring] = [body([e * direction.cos(), e * direction.sin()]), body([0.0; 2])];
    match side {
        GuideSide::CageInside => (ring.velocity, ring.angle, ring.speed) = ([0.0; 2], 0.0, 0.0),
        GuideSide::CageOutside => ring.speed = cage.speed * random.within(1.5, 4.0),
    }
    [cage, ring]
}

/// Largest power of a film as a share of its parts, over all states that have one; negative if every film takes energy.
fn largest_power(layered: bool, shear: PressureShear) -> f64 {
    let mut random = Random::new(20_817);
    let (mut largest, mut films) = (f64::NEG_INFINITY, 0);
    for i in 0..STATES {
        let side = if i % 2 == 0 { GuideSide::CageInside } else { GuideSide::CageOutside };
        let law = law(&mut random, layered, shear, side);
        let [cage, ring] = motion(&mut random, &law, side);
        let motion = side.journal_motion(&cage, &ring);
        let Ok(force) = law.force(&motion, Fluid::SAME) else { continue };
        let parts: Vec<f64> = side
            .wrenches(&force, &motion)
            .iter()
            .zip([&cage, &ring])
            .flat_map(|(wrench, body)| {
                let [y, z] = wrench.force;
                [y * body.velocity[0], z * body.velocity[1], wrench.moment * body.speed]
            })
            .collect();
        let size: f64 = parts.iter().map(|x| x.abs()).sum();
        if size > 0.0 {
            let share = parts.iter().sum::<f64>() / size;
            largest = largest.max(share);
            films += 1;
        }
    }
    assert!(films > STATES / 4, "{films}");
    largest
}

#[test]
fn films_of_new_scenes_take_energy_at_every_motion() {
    for layered in [false, true] {
        let largest = largest_power(layered, PressureShear::WithEdges);
        println!("layer {layered}: {largest:e}");
        assert!(largest <= 1e-9, "layer {layered}: {largest:e}");
    }
}

/// As the papers read them, they do not; reports say so.
#[test]
fn films_of_the_papers_can_give_energy() {
    for layered in [false, true] {
        let largest = largest_power(layered, PressureShear::WithinArc);
        println!("layer {layered}: {largest:e}");
        assert!(largest > 1e-3, "layer {layered}: {largest:e}");
    }
}
