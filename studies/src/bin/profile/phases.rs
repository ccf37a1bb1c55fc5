//! What instructions are spent on, by the functions that they are in.

/// Phases, and parts of the names of their functions. The first function from the innermost on that is of any phase decides;
/// of several phases that it is of, the first.
pub const PHASES: [(&str, &[&str]); 12] = [
    ("memory", &["__mem", "malloc", "realloc", "free"]),
    (
        "derivatives",
        &["slopes", "Slopes", "linearize", "jacobian", "relative", "inverse_inertia", "Linearization"],
    ),
    ("guide", &["laws::guide", "pairs::guide"]),
    ("laws", &["cagedyn::laws", "law_columns", "LineContact", "Batch::apply", "ApplySolid"]),
    ("forces of the step", &["step_forces", "contacts::step", "find_step", "apply_step", "::react"]),
    ("damping and its solution", &["damping", "Divide", "accelerations_of", "respond"]),
    ("powers", &["works", "powers", "power_between", "of_film"]),
    ("watching", &["::watch", "Tally", "tally", "trail", "Trail", "Samples"]),
    (
        "choosing steps",
        &["integrate::driver", "integrate::auto", "longest_step", "onsets", "Ahead", "vibration"],
    ),
    ("method itself", &["integrate::methods", "integrate::linear", "integrate::"]),
    ("collecting forces", &["wrenches", "assemble", "add_on_", "accelerate", "Accelerate"]),
    ("finding motions and contacts", &[""]),
];

/// What a program in plain Rust for the NU2310 scene alone takes for the same, with fixed sizes and nothing that the scene has
/// not: counted once in the same way.
pub const PLAIN: [Option<u32>; PHASES.len()] =
    [None, None, Some(583), Some(4381), None, None, None, None, None, Some(2432), Some(1298), Some(1875)];

/// Phase of an instruction in these functions, from the innermost on.
pub fn phase_of(functions: &[String]) -> usize {
    let of = |name: &String| {
        let scalar = ["cagedyn::scalar", "<cagedyn::scalar"].iter().any(|start| name.starts_with(start));
        let own = name.contains("cagedyn::") && !scalar;
        let named = PHASES.iter().take(PHASES.len() - 1);
        named.clone().position(|(_, parts)| {
            parts.iter().any(|part| (own || part.starts_with("__")) && name.contains(part))
        })
    };
    functions.iter().find_map(of).unwrap_or(PHASES.len() - 1)
}
