//! Calls about steady whirl and heat.

use super::{Host, UNTOUCHED};
use cagedyn::capi::heat::*;
use cagedyn::capi::motion::*;
use cagedyn::capi::whirl::*;
use cagedyn::capi::*;
use std::ptr::{null, null_mut};

impl Host {
    pub(super) fn about_whirl(&mut self) {
        let whirl = if self.one_of(10) { null_mut() } else { self.whirl };
        let (point, model, out) = (self.index(1), self.model(), self.out());
        let text = self.text();
        let text = text.as_ref().map_or(null(), |text| text.as_ptr());
        // SAFETY: as above.
        unsafe {
            match self.rng.u32(0..7) {
                0 => {
                    let n = self.length(cagedyn_whirl_quantity_count());
                    let status = cagedyn_whirl_point(whirl, point, out, n);
                    self.check("point", status.into());
                }
                1 => {
                    let n = self.length(0);
                    let status = cagedyn_whirl_amplitudes(whirl, point, out, n);
                    self.check("amplitudes", status.into());
                }
                2 => {
                    let n = self.length(cagedyn_whirl_eigenvalue_count(self.whirl));
                    let mut frequencies = [UNTOUCHED; 32];
                    let status = cagedyn_whirl_eigenvalues(whirl, point, out, frequencies.as_mut_ptr(), n);
                    assert_eq!(status == CAGEDYN_OK, frequencies[0].to_bits() != UNTOUCHED.to_bits());
                    self.check("eigenvalues", status.into());
                }
                3 => {
                    let count = cagedyn_whirl_wave_count(whirl);
                    self.check("waves", count);
                }
                4 => {
                    let count = cagedyn_whirl_point_count(whirl);
                    self.check("points", count);
                }
                5 if self.one_of(2) => {
                    let numbers: Vec<f64> = (0..20).map(|i| f64::from(i) + self.number()).collect();
                    let (x, n) = (numbers.as_ptr(), self.length(20).min(20));
                    let y = if self.one_of(8) { null() } else { x };
                    let m = self.length(cagedyn_motion_count());
                    let (clearance, from) = (self.number(), self.number());
                    let status = cagedyn_cage_motion(x, y, x, y, x, n, clearance, from, out, m);
                    self.check("motion", status.into());
                    let (sectors, m) = (self.index(100), self.length(400));
                    let status = cagedyn_over_orbit(x, y, n, sectors, out, m);
                    self.check("over orbit", status.into());
                }
                5 => {
                    assert!(!cagedyn_whirl_end(whirl).is_null() && !cagedyn_whirl_why(whirl).is_null());
                    assert!(!cagedyn_whirl_quantity_name(point).is_null());
                }
                _ => {
                    // None of these texts is the path of a number.
                    let made = cagedyn_whirl_follow(model, text, self.number(), self.number());
                    assert!(made.is_null() && cagedyn_error_status() != CAGEDYN_OK);
                }
            }
        }
    }

    pub(super) fn about_heat(&mut self) {
        let heat = if self.one_of(10) { null_mut() } else { self.heat };
        let (place, out, lumps) = (self.index(6), self.out(), self.length(6));
        // SAFETY: as above.
        unsafe {
            match self.rng.u32(0..10) {
                0 => {
                    let status = cagedyn_heat_temperatures(heat, out, lumps);
                    self.check("temperatures", status.into());
                }
                1 => {
                    let warm: Vec<f64> =
                        (0..8).map(|_| if self.one_of(20) { self.number() } else { 320.0 }).collect();
                    let warm = if self.one_of(10) { null() } else { warm.as_ptr() };
                    let status = cagedyn_heat_set_temperatures(heat, warm, lumps.min(8));
                    self.check("set temperatures", status.into());
                }
                2 => {
                    let status = cagedyn_heat_into_lumps(heat, out, lumps);
                    self.check("into lumps", status.into());
                }
                3 => {
                    let n = self.length(cagedyn_heat_link_count(self.heat));
                    let status = cagedyn_heat_flows(heat, out, n);
                    self.check("flows", status.into());
                }
                4 => {
                    let n = self.length(2);
                    let mut ends = [7; 2];
                    let status = cagedyn_heat_link(heat, place, ends.as_mut_ptr(), n);
                    assert_eq!(status == CAGEDYN_OK, ends[0] != 7);
                    self.check("link", status.into());
                }
                5 => {
                    let n = self.length(cagedyn_heat_source_count(self.heat));
                    let status = cagedyn_heat_sources(heat, out, n);
                    self.check("sources", status.into());
                }
                6 => {
                    let n = self.length(cagedyn_heat_quantity_count());
                    let status = cagedyn_heat_quantities(heat, out, n);
                    self.check("quantities", status.into());
                }
                7 => {
                    let counts = [
                        cagedyn_heat_lump_count(heat),
                        cagedyn_heat_link_count(heat),
                        cagedyn_heat_source_count(heat),
                    ];
                    self.check("counts", counts[0]);
                    assert!(counts.iter().all(|count| (*count < 0) == heat.is_null()));
                }
                8 => {
                    let names = [
                        cagedyn_heat_lump_name(heat, place),
                        cagedyn_heat_source_name(heat, place),
                        cagedyn_heat_quantity_name(place),
                    ];
                    assert!(names.iter().all(|name| !name.is_null()));
                }
                _ if self.one_of(50) => {
                    let status = cagedyn_heat_step(heat, 10.0);
                    self.check("step", status.into());
                }
                _ => {
                    // One that is too long, or none.
                    let duration = if self.one_of(2) { f64::NAN } else { 1e10 };
                    assert!(cagedyn_heat_step(heat, duration) < CAGEDYN_OK);
                    assert!(cagedyn_heat_new(self.model()).is_null() && cagedyn_error_status() != CAGEDYN_OK);
                }
            }
        }
    }
}
