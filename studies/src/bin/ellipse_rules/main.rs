//! Errors of the sums over the ellipse of a ball, by the number of places, with the time that each takes: docs/results/ellipse-rules.md.

use cagedyn::laws::traction::ellipse::{EllipseRule, EllipseState, EllipseTraction};
use cagedyn::laws::traction::self_heating::SelfHeating;
use cagedyn::model::{SPATIAL_CONTACT_QUANTITIES, SpatialContact};
use cagedyn::{Model, Scene, Sim};
use cagedyn_studies::table::Table;
use std::error::Error;
use std::fs;
use std::hint::black_box;
use std::sync::Arc;
use std::time::Instant;

/// Strips and places along each, of stress and of temperature: the three rules that scenes name, then others.
const RULES: [(&str, [usize; 2], [usize; 2]); 8] = [
    ("`coarse`: 8 x 2", [8, 2], [8, 2]),
    ("`standard`: 16 x 2, of the temperature 8 x 2", [16, 2], [8, 2]),
    ("16 x 2", [16, 2], [16, 2]),
    ("24 x 2", [24, 2], [24, 2]),
    ("24 x 4", [24, 4], [24, 4]),
    ("`fine`: 32 x 4", [32, 4], [32, 4]),
    ("64 x 6", [64, 6], [64, 6]),
    ("128 x 8", [128, 8], [128, 8]),
];
/// The rule that counts as exact.
const EXACT: [usize; 2] = [1024, 24];
/// Evaluations of one measurement of the time, and measurements of which the shortest counts.
const EVALUATIONS: u32 = 2000;
const MEASUREMENTS: usize = 9;
const STEEL: f64 = 46.0 * 7830.0 * 460.0;

/// A contact: what is summed over its ellipse, and the radius of the pressed surface, m.
struct Contact {
    name: &'static str,
    state: EllipseState<f64>,
    pressed_radius: f64,
}

/// The contact of the first ball with a race (0 outer, 1 inner) at the start of a scene with these changes.
fn contact(
    name: &'static str,
    file: &str,
    changes: &[(&str, &str)],
    race: usize,
) -> Result<Contact, Box<dyn Error>> {
    let text = fs::read_to_string(file)?;
    let model = Arc::new(Model::new(Scene::from_json_with(&text, changes.iter().copied())?)?);
    let scene = model.scene();
    let (balls, outer, inner) = (scene.balls.as_ref(), scene.outer_ring.as_ref(), scene.inner_ring.as_ref());
    let radius = balls.ok_or("no balls")?.radius;
    let groove =
        if race == 0 { outer.and_then(|r| r.groove_radius) } else { inner.and_then(|r| r.groove_radius) };
    let groove = groove.ok_or("no groove")?;
    let mut sim = Sim::new(model.clone())?;
    let values: SpatialContact = sim.forces()?.space.contacts[race];
    let of = |name: &str| {
        SPATIAL_CONTACT_QUANTITIES.iter().position(|q| q.name == name).map_or(f64::NAN, |i| values[i])
    };
    let [u1, u2] = [of("surface_speed_ball"), of("surface_speed_ring")];
    let state = EllipseState {
        pressure: of("largest_pressure"),
        half_axes: [of("half_axis_across"), of("half_axis_along")],
        film: of("film_thickness"),
        ln_viscosity: 0.0,
        rolling_speed: (0.25 * (u1 + u2) * (u1 + u2) + 1e-12).sqrt(),
        surface_speeds: [u1, u2],
        slip: [of("slip_along"), of("slip_across")],
        turning: [of("turning_along"), of("turning_across"), of("turning_normal")],
        boundary_share: 0.0,
    };
    Ok(Contact { name, state, pressed_radius: 2.0 * groove * radius / (groove + radius) })
}

fn law(contact: &Contact, stress: [usize; 2], temperature: [usize; 2]) -> EllipseTraction {
    let rule = |[strips, places]: [usize; 2]| EllipseRule::new(strips, places);
    EllipseTraction {
        rule: rule(stress),
        temperature_rule: rule(temperature),
        ln_time: (0.03_f64 / 5e6).ln(),
        pressure_viscosity: 2e-8,
        eyring_stress: 5e6,
        shear_modulus: 3e8,
        pressed_radius: contact.pressed_radius,
        self_heating: Some(SelfHeating {
            temperature_viscosity: 0.04,
            conductivity: 0.13,
            eyring_stress: 5e6,
            thermal_product_1: STEEL,
            thermal_product_2: STEEL,
            acts: 1.0,
        }),
    }
}

/// Forces (N) and couples over the longer half axis (N) of a contact, and its temperature rise, K.
fn found(contact: &Contact, stress: [usize; 2], temperature: [usize; 2]) -> ([f64; 5], f64) {
    let friction = law(contact, stress, temperature).friction(&contact.state, None);
    let a = contact.state.half_axes[0];
    let ([ft, fl], [mt, ml, mn]) = (friction.force, friction.couple);
    ([ft, fl, mt / a, ml / a, mn / a], friction.temperature_rise)
}

/// About the integral of the stress over the ellipse, N: lost power over the mean slip.
fn size(contact: &Contact, exact: &[f64; 5]) -> f64 {
    let EllipseState { half_axes: [a, b], slip: [dt, dl], turning: [wt, wl, wn], .. } = contact.state;
    let [ft, fl, mt, ml, mn] = *exact;
    let power = -(ft * dt + fl * dl + a * (mt * wt + ml * wl + mn * wn));
    let r = contact.pressed_radius;
    let (mut sum, mut count) = (0.0, 0.0);
    let n = 200;
    for i in 0..n {
        for k in 0..n {
            let [u, v] = [i, k].map(|i| (2.0 * f64::from(i) + 1.0) / f64::from(n) - 1.0);
            if u * u + v * v < 1.0 {
                let (x, y) = (b * u, a * v);
                let height = y * y / (r + (r * r - y * y).sqrt());
                sum += (dt - wn * y - wl * height).hypot(dl + wn * x + wt * height);
                count += 1.0;
            }
        }
    }
    power / (sum / count)
}

fn seconds(contact: &Contact, stress: [usize; 2], temperature: [usize; 2]) -> f64 {
    let law = law(contact, stress, temperature);
    let once = || {
        let start = Instant::now();
        for _ in 0..EVALUATIONS {
            black_box(law.friction(black_box(&contact.state), None));
        }
        start.elapsed().as_secs_f64() / f64::from(EVALUATIONS)
    };
    (0..MEASUREMENTS).map(|_| once()).fold(f64::INFINITY, f64::min)
}

fn main() -> Result<(), Box<dyn Error>> {
    let fast = [("inner_ring.speed.constant", "1047.1975511965977")];
    let angular = "scenes/angular_contact_218.json";
    let deep =
        [("inner_ring.speed.constant", "314.1592653589793"), ("initial.inner_ring", "\"equilibrium\"")];
    let light = [("inner_ring.motion.space.load.x.constant", "300.0")];
    let series_70 = "scenes/angular_contact_70.json";
    let contacts = [
        contact("218, 17.8 kN, 10 000 rev/min, inner", angular, &fast, 1)?,
        contact("the same, outer", angular, &fast, 0)?,
        contact(
            "6206, 3 kN radial, 3000 rev/min, inner, loaded most",
            "scenes/deep_groove_6206.json",
            &deep,
            1,
        )?,
        contact("series 70, 687 N, 3000 rev/min, inner", series_70, &[], 1)?,
        contact("series 70, 300 N, inner", series_70, &light, 1)?,
        contact("series 70, 300 N, outer", series_70, &light, 0)?,
    ];
    let mut errors = Table::new("errors", &[]);
    errors.head = std::iter::once("rule").chain(contacts.iter().map(|c| c.name)).map(str::to_owned).collect();
    errors.head.push("time over `standard`".to_owned());
    let exact: Vec<_> = contacts.iter().map(|c| found(c, EXACT, EXACT)).collect();
    let usual = seconds(&contacts[0], RULES[1].1, RULES[1].2);
    for (name, stress, temperature) in RULES {
        let mut line = vec![name.to_owned()];
        for (contact, (exact, warm)) in contacts.iter().zip(&exact) {
            let (forces, rise) = found(contact, stress, temperature);
            let off = forces.iter().zip(exact).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
            line.push(format!("{:.0e}, {:.0e}", off / size(contact, exact), (rise / warm - 1.0).abs()));
        }
        line.push(format!("{:.2}", seconds(&contacts[0], stress, temperature) / usual));
        errors.lines.push(line);
    }
    print!(
        "# Errors of the sums over an ellipse\n\n\
         Traction of a ball is summed over strips of its ellipse and places along each (`raceways.ellipse` of a scene). Each cell: largest error \
         of the two forces and of the three couples over the longer half axis, over the integral of the stress over the ellipse (lost \
         power over mean slip); then that of the temperature rise, over itself. Exact is the rule of {} x {}. Contacts are those of \
         the first ball at the start of the scene, in the steady motion. The last column is the time of one evaluation of the first contact \
         by scalar code in this run, over that of `standard`. Printed by `make ellipse-rules`.\n\n{}",
        EXACT[0],
        EXACT[1],
        errors.text()
    );
    Ok(())
}
