//! Published roller bearings at rest: loads of all rollers against a static solution with exact distances, and the stiffness.

use crate::common::reports::NORMAL;
use crate::common::set;
use cagedyn::{Model, Sim};
use cagedyn_studies::bearings::Bearing;
use serde_json::{Value, json};
use std::f64::consts::TAU;
use std::sync::Arc;

/// A ring displaced among rollers that stay at their angles: `angles`, rad, and half the clearance, m.
struct Statics<'a> {
    bearing: &'a Bearing,
    angles: Vec<f64>,
    clearance: f64,
}

impl Statics<'_> {
    /// Force of roller `angle` on the ring, its loads on inner and outer raceway, at a place of the ring. The roller is where its
    /// forces balance along the radius; distances are those of circles, not of their projections.
    fn roller(&self, [y, z]: [f64; 2], angle: f64) -> ([f64; 2], [f64; 2]) {
        let (radius, pitch) = (self.bearing.radius(), self.bearing.pitch());
        let outer = pitch + radius;
        let inner = outer - 2.0 * radius - 0.5 * self.clearance;
        let (sin, cos) = angle.sin_cos();
        let loads = |r: f64| {
            let (dy, dz) = (r * cos - y, r * sin - z);
            let distance = dy.hypot(dz);
            let inner_load = self.bearing.contact_load(inner + radius - distance);
            let outer_load = self.bearing.contact_load(r + radius - outer);
            (inner_load, outer_load, [dy / distance, dz / distance])
        };
        let (mut low, mut high) = (pitch - self.clearance.abs() - 1e-3, pitch + self.clearance.abs() + 1e-3);
        for _ in 0..200 {
            let r = 0.5 * (low + high);
            let (inner_load, outer_load, [ny, nz]) = loads(r);
            if inner_load * (ny * cos + nz * sin) > outer_load { low = r } else { high = r }
        }
        let (inner_load, outer_load, [ny, nz]) = loads(0.5 * (low + high));
        ([-inner_load * ny, -inner_load * nz], [inner_load, outer_load])
    }

    fn force(&self, place: [f64; 2]) -> [f64; 2] {
        let forces = self.angles.iter().map(|angle| self.roller(place, *angle).0);
        forces.fold([0.0; 2], |[y, z], [a, b]| [y + a, z + b])
    }

    /// Place of the ring under a load downwards, by damped Newton steps.
    fn place(&self, load: f64) -> [f64; 2] {
        let rest = |place| {
            let [y, z] = self.force(place);
            [y, z - load]
        };
        let size = |[y, z]: [f64; 2]| y.hypot(z);
        // As deep as one roller alone gives way, twice: contact loads go with the power 10/9 of the approach.
        let approach = 1e-6 * (load / self.bearing.contact_load(1e-6)).powf(0.9);
        let mut x = [0.0, -0.5 * self.clearance - 2.0 * approach];
        let mut damping = 0.0;
        for _ in 0..2000 {
            let here = rest(x);
            if size(here) < 1e-11 * load {
                break;
            }
            let h = 1e-10;
            let [a, b] = [[h, 0.0], [0.0, h]].map(|d| {
                let [plus, minus] = [1.0, -1.0].map(|s| rest([x[0] + s * d[0], x[1] + s * d[1]]));
                [(plus[0] - minus[0]) / (2.0 * h), (plus[1] - minus[1]) / (2.0 * h)]
            });
            // Where one roller carries alone the ring is free to its side: the damping of Levenberg and Marquardt.
            let (a, b) = ([a[0] - damping, a[1]], [b[0], b[1] - damping]);
            let det = a[0] * b[1] - a[1] * b[0];
            let step = [(here[0] * b[1] - here[1] * b[0]) / det, (a[0] * here[1] - a[1] * here[0]) / det];
            let next = [x[0] - step[0], x[1] - step[1]];
            if size(rest(next)) < size(here) {
                (x, damping) = (next, 0.1 * damping);
            } else {
                damping = (10.0 * damping).max(1e-9 * (a[0].abs() + b[1].abs()));
            }
        }
        assert!(size(rest(x)) < 1e-8 * load, "{}: no equilibrium", self.bearing.name);
        x
    }
}

fn sim(scene: &Value) -> Sim {
    Sim::new(Arc::new(Model::from_json(&scene.to_string()).unwrap_or_else(|e| panic!("{e}")))).unwrap()
}

/// The bearing at rest with its first roller at this angle, rad.
fn at_rest(bearing: &Bearing, clearance: f64, load: f64, first: f64) -> Sim {
    let mut scene = bearing.rollers_at_rest(clearance, load);
    set(&mut scene, "initial.first_roller_angle", json!(first));
    sim(&scene)
}

/// Angles of the rollers, rad.
fn angles(bearing: &Bearing, first: f64) -> Vec<f64> {
    (0..bearing.count).map(|j| first + TAU * j as f64 / bearing.count as f64).collect()
}

#[test]
fn lengths_of_rollers_have_the_static_rating_of_the_catalogue() {
    let mut checked = 0;
    for bearing in Bearing::with_rollers() {
        if let (Some(given), Some(found)) = (bearing.static_rating, bearing.static_rating()) {
            checked += 1;
            assert!((found / (1e3 * given) - 1.0).abs() < 0.02, "{}: {found} N", bearing.name);
        }
    }
    assert!(checked >= 7);
}

#[test]
fn every_roller_at_rest_has_the_load_of_exact_distances() {
    let mut first_order = 0.0f64;
    for bearing in Bearing::with_rollers() {
        let rating = bearing.static_rating().unwrap();
        let [least, most] = bearing.clearance.map(|um| 1e-6 * um);
        for (clearance, share, first) in
            [(least, 0.3, 0.3), (most, 0.05, -1.25), (0.0, 0.1, 0.0), (-least.min(1e-4), 0.1, 1.1)]
        {
            let load = share * rating;
            let mut sim = at_rest(bearing, clearance, load, first);
            let statics = Statics { bearing, angles: angles(bearing, first), clearance };
            let place = statics.place(load);
            let forces = sim.forces().unwrap();
            let expected: Vec<[f64; 2]> =
                statics.angles.iter().map(|a| statics.roller(place, *a).1).collect();
            let largest = expected.iter().flatten().fold(0.0f64, |a, b| a.max(*b));
            for (j, (found, [inner, outer])) in forces.contacts.chunks_exact(2).zip(&expected).enumerate() {
                for (found, expected) in [(found[0][NORMAL], outer), (found[1][NORMAL], inner)] {
                    let apart = (found - expected).abs() / largest;
                    assert!(
                        apart < 1e-6,
                        "{}, {clearance} m, {load} N: roller {j} has {found} instead of {expected} N",
                        bearing.name
                    );
                }
                // What a projection on the angle would give at the same place of the ring.
                let angle = statics.angles[j];
                let squeeze = -place[0] * angle.cos() - place[1] * angle.sin();
                let projected = bearing.contact_load(0.5 * (-squeeze - 0.5 * clearance));
                first_order = first_order.max((projected - inner).abs() / largest);
            }
        }
    }
    // The check would see a model that projects.
    assert!(first_order > 2e-5, "{first_order:e}");
}

#[test]
fn without_clearance_a_bearing_is_as_stiff_as_kraemer_has_it() {
    for bearing in Bearing::with_rollers() {
        for share in [0.02, 0.2] {
            let load = share * bearing.static_rating().unwrap();
            let phases = 4;
            let stiffness: f64 = (0..phases)
                .map(|k| {
                    let first = TAU / bearing.count as f64 * f64::from(k) / f64::from(phases);
                    let [low, high] = [0.99, 1.01].map(|factor| {
                        let sim = at_rest(bearing, 0.0, factor * load, first);
                        sim.state()[1]
                    });
                    0.02 * load / (low - high) / f64::from(phases)
                })
                .sum();
            let expected = bearing.kraemer_stiffness(load);
            assert!(
                (stiffness / expected - 1.0).abs() < 0.03,
                "{}, {load} N: {stiffness:e} instead of {expected:e} N/m",
                bearing.name
            );
        }
    }
}
