//! The twelve bearings, and the page that shows them.

use super::Bearing;
use super::Elements::{Balls, Rollers};

/// Bearings with rollers first.
pub const TWELVE: [Bearing; 12] = [
    Bearing {
        name: "NU 206",
        boundary: [30.0, 62.0, 16.0],
        count: 13,
        elements: Rollers { raceways: [37.5, 55.5], length: 8.8 },
        clearance: [20.0, 45.0],
        caged: true,
        static_rating: Some(36.5),
        source: "SKF, Rolling bearings (2018), NU 206 ECP: d, D, B, F, E, C0",
        assumed: "number of rollers; length from C0",
    },
    Bearing {
        name: "NU 215",
        boundary: [75.0, 130.0, 25.0],
        count: 18,
        elements: Rollers { raceways: [88.5, 118.5], length: 15.4 },
        clearance: [40.0, 75.0],
        caged: true,
        static_rating: Some(156.0),
        source: "SKF, Rolling bearings (2018), NU 215 ECP: d, D, B, F, E, C0",
        assumed: "number of rollers; length from C0",
    },
    Bearing {
        name: "NU 1010",
        boundary: [50.0, 80.0, 16.0],
        count: 20,
        elements: Rollers { raceways: [57.5, 72.5], length: 9.6 },
        clearance: [30.0, 60.0],
        caged: true,
        static_rating: Some(56.0),
        source: "SKF, Rolling bearings (2018), NU 1010 ECP: d, D, B, F, E, C0",
        assumed: "number of rollers; length from C0",
    },
    Bearing {
        name: "NJ 2309",
        boundary: [45.0, 100.0, 36.0],
        count: 11,
        elements: Rollers { raceways: [54.5, 88.5], length: 24.4 },
        clearance: [30.0, 60.0],
        caged: true,
        static_rating: Some(153.0),
        source: "SKF, Rolling bearings (2018), NJ 2309 ECP: d, D, B, F, E, C0",
        assumed: "number of rollers; length from C0",
    },
    Bearing {
        name: "NJ 2313",
        boundary: [65.0, 140.0, 48.0],
        count: 12,
        elements: Rollers { raceways: [82.5, 124.5], length: 32.8 },
        clearance: [40.0, 70.0],
        caged: true,
        static_rating: Some(290.0),
        source: "SKF, Rolling bearings (2018), NJ 2313 ECP, as in gearboxes: d, D, B, F, E, C0; a roller of some 20 mm x 34 mm",
        assumed: "number of rollers; length from C0",
    },
    Bearing {
        name: "NCF 3008 V",
        boundary: [40.0, 68.0, 21.0],
        count: 21,
        elements: Rollers { raceways: [45.74, 61.74], length: 11.05 },
        clearance: [25.0, 50.0],
        caged: false,
        static_rating: Some(69.5),
        source: "SKF, Rolling bearings (2018), NCF 3008 CV: d, D, B, E, C0; full complement",
        assumed: "21 rollers of 8 mm fill the pitch circle to 0.2 mm; length from C0",
    },
    Bearing {
        name: "NU 18/500",
        boundary: [500.0, 620.0, 56.0],
        count: 40,
        elements: Rollers { raceways: [528.0, 592.0], length: 30.0 },
        clearance: [220.0, 330.0],
        caged: true,
        static_rating: None,
        source: "ISO 15, dimension series 18: d, D, B",
        assumed: "40 rollers of 32 mm x 32 mm in the middle of the section",
    },
    Bearing {
        name: "HK 0306",
        boundary: [3.0, 6.5, 6.0],
        count: 10,
        elements: Rollers { raceways: [3.0, 5.0], length: 2.7 },
        clearance: [6.0, 20.0],
        caged: true,
        static_rating: Some(0.88),
        source: "Schaeffler, Rolling bearings (HR 1), drawn cup HK0306: Fw, D, C, C0",
        assumed: "10 needles of 1 mm; length from C0; clearance of a fitted cup; the shaft is the inner ring",
    },
    Bearing {
        name: "6205",
        boundary: [25.0, 52.0, 15.0],
        count: 9,
        elements: Balls { diameter: 7.94, pitch: 39.04, contact_angle: 0.0 },
        clearance: [5.0, 20.0],
        caged: true,
        static_rating: None,
        source: "Case Western Reserve University, Bearing Data Center: 9 balls of 0.3126 in on 1.537 in",
        assumed: "nothing of what is used",
    },
    Bearing {
        name: "7008 C",
        boundary: [40.0, 68.0, 15.0],
        count: 17,
        elements: Balls { diameter: 7.938, pitch: 54.0, contact_angle: 15.0 },
        clearance: [0.0, 0.0],
        caged: true,
        static_rating: None,
        source: "NSK, Super precision bearings, 7008C: d, D, B, angle, C0",
        assumed: "17 balls of 5/16 in have its C0 by ISO 76; pitch is the mean of d and D",
    },
    Bearing {
        name: "7206 B",
        boundary: [30.0, 62.0, 16.0],
        count: 14,
        elements: Balls { diameter: 9.525, pitch: 46.0, contact_angle: 40.0 },
        clearance: [0.0, 0.0],
        caged: true,
        static_rating: None,
        source: "NSK, New 40 degree angular contact ball bearings, 7206BEA: d, D, B, angle, C0 14.3 kN",
        assumed: "14 balls of 3/8 in have its C0 by ISO 76; pitch is the mean of d and D",
    },
    Bearing {
        name: "SR 144",
        boundary: [3.175, 6.35, 2.38],
        count: 8,
        elements: Balls { diameter: 1.0, pitch: 4.7625, contact_angle: 12.0 },
        clearance: [0.0, 0.0],
        caged: true,
        static_rating: None,
        source: "Inch series of dental handpieces, R144: d, D, 7 or 8 balls of 1 mm",
        assumed: "8 balls; pitch is the mean of d and D; contact angle",
    },
];

/// A page with all that scenes are made of.
pub fn page() -> String {
    let mut text = String::from(
        "# Bearings that others publish\n\n\
         `target/release/judge --bearings` prints this page. Tests and `judge --published` set up scenes from these data, which stand in\n\
         [table.rs](../../studies/src/bearings/table.rs). Makers publish boundary dimensions, raceway diameters and load ratings, and\n\
         hardly ever the number and length of rollers: these follow from the static rating of ISO 76, $C_0 = 44 (1 - D_w/D_{pw}) Z L_{we} D_w$\n\
         in N and mm, with the number that leaves room for a cage. Where no rating is given the length is assumed. Clearances\n\
         of rollers are those of group N of ISO 5753-1, unless another one is named.\n\
         Balls have their motion prescribed and need none. Masses of rollers and inner rings are those of solid steel; cages,\n\
         their guides, pockets and masses are drawn at random, as no maker publishes them. Values were not compared with printed\n\
         copies of their sources; that ratings follow from sizes speaks for both, and tests need no more than that a row fits together.\n\n\
         | bearing | d, D, B, mm | elements | size, mm | raceways or pitch, mm | clearance, um | $C_0$, kN, given and from the size | source | assumed |\n\
         |---|---|---:|---|---|---|---|---|---|\n",
    );
    for bearing in &TWELVE {
        let [d, outside, width] = bearing.boundary;
        let (size, circles) = match bearing.elements {
            Rollers { raceways: [f, e], length } => {
                (format!("rollers {} x {length}", 0.5 * (e - f)), format!("F {f}, E {e}"))
            }
            Balls { diameter, pitch, contact_angle } => {
                (format!("balls {diameter}, {contact_angle} degrees"), format!("pitch {pitch}"))
            }
        };
        let clearance = match bearing.elements {
            Rollers { .. } => format!("{} to {}", bearing.clearance[0], bearing.clearance[1]),
            Balls { .. } => String::new(),
        };
        let rating = match (bearing.static_rating, bearing.static_rating()) {
            (Some(given), Some(found)) => format!("{given}, {:.3}", 1e-3 * found),
            (None, Some(found)) => format!("none, {:.0}", 1e-3 * found),
            _ => String::new(),
        };
        text += &format!(
            "| {} | {d}, {outside}, {width} | {} | {size} | {circles} | {clearance} | {rating} | {} | {} |\n",
            bearing.name, bearing.count, bearing.source, bearing.assumed
        );
    }
    text
}
