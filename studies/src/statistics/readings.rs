//! What is read from a run: one number per quantity from outputs recorded on a fixed grid of times.

use crate::spectrum::{Analysis, Spectrum};
use cagedyn::{Recording, Sim, Spread};
use std::f64::consts::TAU;

/// A spectral line is the largest amplitude within this many lines of the frequency: the cage frequency of a run
/// does not fall on one.
const LINE_REACH: f64 = 1.5;

/// A number that a run gives.
pub struct Quantity {
    /// Name and unit, for headings.
    pub name: &'static str,
    /// Short name, for narrow columns.
    pub short: &'static str,
    value: fn(&Results<'_>) -> Option<f64>,
}

/// All quantities; a scene without what one needs does without it.
pub const QUANTITIES: [Quantity; 14] = [
    quantity("cage y, share of clearance", "y", |r| r.mean("cage.y_ratio")),
    quantity("cage z, share of clearance", "z", |r| r.mean("cage.z_ratio")),
    quantity("orbit of the cage centre, rad/s", "orbit", |r| r.orbit_speed()),
    quantity("eccentricity of the cage", "ecc.", |r| r.mean("cage.eccentricity")),
    quantity("cage slip, %", "slip", |r| r.mean("cage.slip").map(|x| 100.0 * x)),
    quantity("roller slip, %", "roller", |r| r.roller_slip()),
    quantity("drag torque, N m", "torque", |r| r.drag_torque()),
    quantity("largest pocket force, mean, N", "pocket", |r| Some(r.pocket_force()?.mean)),
    quantity("largest pocket force, 95 %, N", "p95", |r| Some(r.pocket_force()?.p95)),
    quantity("largest raceway load, mean, N", "load", |r| Some(r.largest_of("outer_force")?.mean)),
    quantity("highest line of cage z, um", "peak", |r| Some(1e6 * r.spectrum()?.0.highest()?.amplitude)),
    quantity("line of cage z at f_c, um", "f_c", |r| r.line(1.0)),
    quantity("line of cage z at Z f_c, um", "Z f_c", |r| r.line(r.elements() as f64)),
    quantity("approach speed in loaded raceways, rms, mm/s", "approach", |r| r.approach_speed()),
];

const fn quantity(
    name: &'static str,
    short: &'static str,
    value: fn(&Results<'_>) -> Option<f64>,
) -> Quantity {
    Quantity { name, short, value }
}

/// Outputs and states of a run on a fixed grid of times.
#[derive(Default)]
pub struct Record {
    outputs: Recording,
    /// Radial speeds of all rollers, m/s; one row per record.
    radial_speeds: Vec<Vec<f64>>,
}

impl Record {
    /// Adds the present outputs of a simulation.
    ///
    /// # Errors
    /// As [`Sim::outputs`].
    pub fn add(&mut self, sim: &mut Sim) -> cagedyn::Result<()> {
        self.outputs.columns.resize(sim.channels().len(), Vec::new());
        let mut row = vec![0.0; sim.channels().len()];
        sim.outputs(&mut row)?;
        self.outputs.times.push(sim.time());
        for (column, value) in self.outputs.columns.iter_mut().zip(row) {
            column.push(value);
        }
        let infos = sim.model().state_infos();
        let radial = infos.iter().zip(sim.state()).filter(|(info, _)| info.name.ends_with("].radial_speed"));
        self.radial_speeds.push(radial.map(|(_, speed)| *speed).collect());
        Ok(())
    }

    /// Values of all [`QUANTITIES`]; `None` for what the scene has not.
    pub fn values(&self, sim: &Sim) -> Vec<Option<f64>> {
        let results = Results { sim, record: self };
        QUANTITIES.iter().map(|quantity| (quantity.value)(&results)).collect()
    }
}

struct Results<'a> {
    sim: &'a Sim,
    record: &'a Record,
}

impl Results<'_> {
    fn elements(&self) -> usize {
        self.sim.model().element_count()
    }

    fn column(&self, name: &str) -> Option<&[f64]> {
        let place = self.sim.channels().iter().position(|channel| channel.name == name)?;
        self.record.outputs.columns.get(place).map(Vec::as_slice)
    }

    fn mean(&self, name: &str) -> Option<f64> {
        Some(Spread::of(self.column(name)?)?.mean)
    }

    /// Columns of one field of all elements.
    fn of_elements(&self, field: &str) -> Option<Vec<&[f64]>> {
        let ends = format!("].{field}");
        let named = self.sim.channels().iter().zip(&self.record.outputs.columns);
        let columns: Vec<&[f64]> =
            named.filter(|(c, _)| c.name.ends_with(&ends)).map(|(_, column)| column.as_slice()).collect();
        (!columns.is_empty()).then_some(columns)
    }

    /// The largest magnitude among all elements over time.
    fn largest_of(&self, field: &str) -> Option<Spread> {
        let columns = self.of_elements(field)?;
        let records = 0..self.record.outputs.times.len();
        let largest = |i: usize| columns.iter().map(|column| column[i].abs()).fold(0.0, f64::max);
        Spread::of(&records.map(largest).collect::<Vec<f64>>())
    }

    fn pocket_force(&self) -> Option<Spread> {
        self.largest_of("pocket_force")
    }

    /// Mean over all rollers and times, %.
    fn roller_slip(&self) -> Option<f64> {
        let columns = self.of_elements("slip").filter(|columns| columns.len() == self.elements())?;
        Some(100.0 * Spread::of(&columns.concat())?.mean)
    }

    /// Elements of prescribed motion leave no torque on the ring.
    fn drag_torque(&self) -> Option<f64> {
        self.of_elements("inner_force")?;
        self.mean("inner_ring.drag_torque")
    }

    /// Speed of the cage centre about the guide centre, weighted by the squared radius: near the centre the angle
    /// says nothing.
    fn orbit_speed(&self) -> Option<f64> {
        let (speed, radius) = (self.column("cage.whirl_speed")?, self.column("cage.whirl_radius")?);
        let moment: f64 = speed.iter().zip(radius).map(|(w, r)| w * r * r).sum();
        Some(moment / radius.iter().map(|r| r * r).sum::<f64>())
    }

    /// Of the cage height in m, with the duration of the record in s.
    fn spectrum(&self) -> Option<(Spectrum, f64)> {
        let times = &self.record.outputs.times;
        let duration = times.last()? - times.first()?;
        let interval = duration / (times.len() - 1) as f64;
        let samples = self.column("cage.z")?;
        Some((Analysis::new(samples.len(), interval)?.of(samples), duration))
    }

    /// Amplitude of the line at a multiple of the cage frequency, um.
    fn line(&self, order: f64) -> Option<f64> {
        let (spectrum, duration) = self.spectrum()?;
        let frequency = order * self.mean("cage.speed")?.abs() / TAU;
        let near = |f: f64| (f - frequency).abs() * duration <= LINE_REACH;
        let lines = spectrum.frequencies.iter().zip(&spectrum.amplitudes);
        lines.filter(|(f, _)| near(**f)).map(|(_, a)| 1e6 * a).reduce(f64::max)
    }

    /// Root mean square of the radial speed of the rollers that touch both raceways, mm/s.
    fn approach_speed(&self) -> Option<f64> {
        let inner = self.of_elements("inner_force")?;
        let rows = self.record.radial_speeds.iter().enumerate();
        let speeds = rows.flat_map(|(i, row)| row.iter().zip(&inner).map(move |(v, force)| (*v, force[i])));
        let loaded: Vec<f64> = speeds.filter(|(_, force)| *force > 0.0).map(|(v, _)| v * v).collect();
        Some(1e3 * Spread::of(&loaded)?.mean.sqrt())
    }
}
