//! Output channels: the named quantities that a run records.

use super::forces::{CAGE_BODY, FILM_THICKNESS, Forces, GUIDE, INNER, NORMAL_FORCE, OUTER, POCKET};
use super::{Model, Workspace};

/// A ring slower than this stands still for the slip channels, rad/s.
const STANDSTILL: f64 = 1e-9;

/// What a channel shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Source {
    CageY,
    CageZ,
    CageYRatio,
    CageZRatio,
    CageEccentricity,
    CageSpeed,
    CageSlip,
    GuideY,
    GuideZ,
    GuideMoment,
    GuideFilm,
    RingY,
    RingZ,
    DragTorque,
    OuterRingTorque,
    RollerAngle(usize),
    RollerSlip(usize),
    PocketPosition(usize),
    PocketForce(usize),
    InnerForce(usize),
    OuterForce(usize),
    InnerFilm(usize),
    OuterFilm(usize),
}

/// A named output.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Channel {
    /// Name, for example `cage.y` or `roller[3].slip`.
    pub name: String,
    /// SI unit; "1" for ratios.
    pub unit: &'static str,
    /// What it is.
    pub description: &'static str,
    source: Source,
}

impl Model {
    /// The output channels of this scene.
    pub fn channels(&self) -> Vec<Channel> {
        let mut list = Vec::new();
        let mut add = |name: String, unit, description, source| {
            list.push(Channel { name, unit, description, source });
        };
        if let Some(cage) = &self.cage {
            add("cage.y".into(), "m", "cage centre to the right", Source::CageY);
            add("cage.z".into(), "m", "cage centre upwards", Source::CageZ);
            if cage.guide.is_some() {
                add("cage.y_ratio".into(), "1", "cage.y over the radial guide clearance", Source::CageYRatio);
                add("cage.z_ratio".into(), "1", "cage.z over the radial guide clearance", Source::CageZRatio);
                let text = "distance of the cage centre from the centre over the radial guide clearance";
                add("cage.eccentricity".into(), "1", text, Source::CageEccentricity);
            }
            add("cage.speed".into(), "rad/s", "rotation speed of the cage", Source::CageSpeed);
            let text = "1 - cage speed over the speed without slip";
            add("cage.slip".into(), "1", text, Source::CageSlip);
            if cage.guide.is_some() {
                add("guide.force_y".into(), "N", "guide force on the cage to the right", Source::GuideY);
                add("guide.force_z".into(), "N", "guide force on the cage upwards", Source::GuideZ);
                add("guide.moment".into(), "N m", "guide moment on the cage", Source::GuideMoment);
                add(
                    "guide.minimum_film".into(),
                    "m",
                    "smallest film thickness of the guide",
                    Source::GuideFilm,
                );
            }
        }
        add("inner_ring.y".into(), "m", "inner ring centre to the right", Source::RingY);
        add("inner_ring.z".into(), "m", "inner ring centre upwards", Source::RingZ);
        let text = "torque that keeps the inner ring turning, positive against rolling drag";
        add("inner_ring.drag_torque".into(), "N m", text, Source::DragTorque);
        let text = "moment on the outer ring about its centre, positive counter-clockwise";
        add("outer_ring.torque".into(), "N m", text, Source::OuterRingTorque);
        let pockets = self.cage.as_ref().is_some_and(|c| c.pocket.is_some());
        let films = self.outer.film.is_some();
        for j in 0..self.layout.count {
            let mut add = |field: &str, unit, description, source| {
                add(format!("roller[{j}].{field}"), unit, description, source);
            };
            add("orbit_angle", "rad", "angle of the roller about the bearing", Source::RollerAngle(j));
            add("slip", "1", "1 - spin speed over the spin without slip", Source::RollerSlip(j));
            if pockets {
                let text = "distance ahead of the pocket centre in the direction of rotation";
                add("pocket_position", "m", text, Source::PocketPosition(j));
                let text = "circumferential force on the cage, positive when it drives the cage";
                add("pocket_force", "N", text, Source::PocketForce(j));
            }
            add("inner_force", "N", "normal force on the inner raceway", Source::InnerForce(j));
            add("outer_force", "N", "normal force on the outer raceway", Source::OuterForce(j));
            if films {
                add("inner_film", "m", "central film thickness on the inner raceway", Source::InnerFilm(j));
                add("outer_film", "m", "central film thickness on the outer raceway", Source::OuterFilm(j));
            }
        }
        list
    }

    /// Value of one channel after an evaluation at (`q`, `v`) that was reported into `forces`.
    pub(crate) fn channel_value(
        &self,
        channel: &Channel,
        q: &[f64],
        v: &[f64],
        ws: &Workspace,
        forces: &Forces,
    ) -> f64 {
        let ring_speed = ws.inputs.ring_speed;
        let direction = if ring_speed < 0.0 { -1.0 } else { 1.0 };
        let cage = |k: usize| self.layout.cage.map_or(0.0, |c| q[c + k]);
        let clearance = self.guide_clearance().unwrap_or(f64::INFINITY);
        let guide = |k: usize| forces.bodies[CAGE_BODY][GUIDE][k];
        let contact = |j: usize, k: usize| &forces.contacts[self.contacts_per_roller() * j + k];
        // Without rotation there is no kinematic speed to compare with, and slip is reported as zero.
        let slip = |speed: f64, ratio: f64| {
            if ring_speed.abs() < STANDSTILL { 0.0 } else { 1.0 - speed / (ratio * ring_speed) }
        };
        match channel.source {
            Source::CageY => cage(0),
            Source::CageZ => cage(1),
            Source::CageYRatio => cage(0) / clearance,
            Source::CageZRatio => cage(1) / clearance,
            Source::CageEccentricity => cage(0).hypot(cage(1)) / clearance,
            Source::CageSpeed => self.layout.cage.map_or(0.0, |c| v[c + 2]),
            Source::CageSlip => slip(self.layout.cage.map_or(0.0, |c| v[c + 2]), self.orbit_ratio()),
            Source::GuideY => guide(0),
            Source::GuideZ => guide(1),
            Source::GuideMoment => guide(2),
            Source::GuideFilm => forces.guide_film,
            Source::RingY => self.ring_motion(q, v).0[0],
            Source::RingZ => self.ring_motion(q, v).0[1],
            Source::DragTorque => -direction * forces.bodies[1][INNER][2],
            Source::OuterRingTorque => forces.bodies[0][OUTER][2] + forces.bodies[0][GUIDE][2],
            Source::RollerAngle(j) => self.azimuth(q, j),
            Source::RollerSlip(j) => slip(v[self.layout.spin(j)], self.spin_ratio()),
            Source::PocketPosition(j) => direction * ws.rollers[j].pocket_offset[1],
            Source::PocketForce(j) => {
                let [y, z, _] = forces.bodies[self.roller_body(j)][POCKET];
                -direction * ws.rollers[j].to_local([y, z])[1]
            }
            Source::InnerForce(j) => contact(j, 1)[NORMAL_FORCE],
            Source::OuterForce(j) => contact(j, 0)[NORMAL_FORCE],
            Source::InnerFilm(j) => contact(j, 1)[FILM_THICKNESS],
            Source::OuterFilm(j) => contact(j, 0)[FILM_THICKNESS],
        }
    }
}
