//! The description of a unit: `modelDescription.xml`.

use super::units::exponents;
use super::variables::{Kind, Unit, Variable};
use crate::sim::SparsePattern;
use std::collections::BTreeSet;
use std::fmt::Write;

/// Version of the standard.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standard {
    /// FMI 2.0.
    Two,
    /// FMI 3.0.
    Three,
}

/// Attributes of both interfaces: those that are alike in both versions but for their spelling.
const ABILITIES: [&str; 2] = [
    r#"canGetAndSetFMUstate="true" canSerializeFMUstate="true" providesDirectionalDerivative="true""#,
    r#"canGetAndSetFMUState="true" canSerializeFMUState="true" providesDirectionalDerivatives="true""#,
];

/// The description of a unit whose binary has the name `identifier`, which is one of C.
pub fn describe(unit: &Unit, standard: Standard, identifier: &str) -> String {
    let mut out = Writer { text: "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n".to_owned(), standard };
    out.all(unit, identifier);
    out.text
}

/// Text of an attribute.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => out += "&amp;",
            '<' => out += "&lt;",
            '>' => out += "&gt;",
            '"' => out += "&quot;",
            letter if letter.is_control() => out.push(' '),
            letter => out.push(letter),
        }
    }
    out
}

struct Writer {
    text: String,
    standard: Standard,
}

impl Writer {
    fn line(&mut self, text: &str) {
        self.text += text;
        self.text.push('\n');
    }

    fn is_three(&self) -> bool {
        self.standard == Standard::Three
    }

    fn all(&mut self, unit: &Unit, identifier: &str) {
        let scene = unit.model.scene();
        let name = escaped(scene.title.as_deref().unwrap_or("rolling bearing"));
        let (version, token) = if self.is_three() { ("3.0", "instantiationToken") } else { ("2.0", "guid") };
        let indicators = if self.is_three() { "" } else { " numberOfEventIndicators=\"0\"" };
        self.line(&format!(
            "<fmiModelDescription fmiVersion=\"{version}\" modelName=\"{name}\" {token}=\"{}\" generationTool=\"cagedyn {}\" \
             variableNamingConvention=\"flat\"{indicators}>",
            unit.token(),
            env!("CARGO_PKG_VERSION")
        ));
        let abilities = ABILITIES[usize::from(self.is_three())];
        let [exchange, simulation] = match self.standard {
            Standard::Two => [
                "completedIntegratorStepNotNeeded=\"false\" canNotUseMemoryManagementFunctions=\"true\"",
                "canHandleVariableCommunicationStepSize=\"true\" canInterpolateInputs=\"true\" maxOutputDerivativeOrder=\"0\" \
                 canNotUseMemoryManagementFunctions=\"true\"",
            ],
            Standard::Three => [
                "needsCompletedIntegratorStep=\"true\"",
                "canHandleVariableCommunicationStepSize=\"true\" hasEventMode=\"true\"",
            ],
        };
        self.line(&format!("  <ModelExchange modelIdentifier=\"{identifier}\" {exchange} {abilities}/>"));
        self.line(&format!("  <CoSimulation modelIdentifier=\"{identifier}\" {simulation} {abilities}/>"));
        self.units(&unit.variables);
        self.line("  <LogCategories>\n    <Category name=\"logStatusError\" description=\"what went wrong\"/>\n  </LogCategories>");
        let record = &scene.record;
        self.line(&format!(
            "  <DefaultExperiment startTime=\"0\" stopTime=\"{:?}\" stepSize=\"{:?}\"/>",
            record.duration, record.interval
        ));
        self.variables(unit);
        self.structure(unit);
        self.line("</fmiModelDescription>");
    }

    fn units(&mut self, variables: &[Variable]) {
        let names: BTreeSet<&str> = variables.iter().map(|variable| variable.unit).collect();
        self.line("  <UnitDefinitions>");
        for name in names {
            let Some(exponents) = exponents(name) else { continue };
            let present = exponents.iter().filter(|(_, exponent)| *exponent != 0);
            let base: String = present.map(|(unit, exponent)| format!(" {unit}=\"{exponent}\"")).collect();
            self.line(&format!("    <Unit name=\"{name}\"><BaseUnit{base}/></Unit>"));
        }
        self.line("  </UnitDefinitions>");
    }

    fn variables(&mut self, unit: &Unit) {
        let scales = unit.model.state_scales();
        self.line("  <ModelVariables>");
        for (reference, variable) in unit.variables.iter().enumerate() {
            let (causality, variability, initial) = match variable.kind {
                Kind::Time => ("independent", "continuous", ""),
                Kind::Parameter(_) => ("parameter", "fixed", " initial=\"exact\""),
                Kind::Input(_) => ("input", "continuous", ""),
                Kind::Output(_) => ("output", "continuous", " initial=\"calculated\""),
                Kind::State(_) | Kind::Rate(_) => ("local", "continuous", " initial=\"calculated\""),
            };
            let mut of_type = String::new();
            if exponents(variable.unit).is_some() {
                let _ = write!(of_type, " unit=\"{}\"", variable.unit);
            }
            if let Kind::State(k) = variable.kind {
                let _ = write!(of_type, " nominal=\"{:?}\"", scales[k]);
            }
            if let Kind::Rate(k) = variable.kind {
                let state = unit.states as usize + k;
                let _ = write!(of_type, " derivative=\"{}\"", self.named(state));
            }
            if let Some(start) = variable.start {
                let _ = write!(of_type, " start=\"{start:?}\"");
            }
            let (name, description) = (escaped(&variable.name), escaped(&variable.description));
            let common = format!(
                "name=\"{name}\" valueReference=\"{reference}\" description=\"{description}\" causality=\"{causality}\" \
                 variability=\"{variability}\"{initial}"
            );
            self.line(&if self.is_three() {
                format!("    <Float64 {common}{of_type}/>")
            } else {
                format!("    <ScalarVariable {common}><Real{of_type}/></ScalarVariable>")
            });
        }
        self.line("  </ModelVariables>");
    }

    /// How the structure names a variable: by value reference, or by its place counted from 1.
    fn named(&self, reference: usize) -> usize {
        if self.is_three() { reference } else { reference + 1 }
    }

    fn structure(&mut self, unit: &Unit) {
        let (direct, slopes) = (unit.model.feedthrough_pattern(), unit.model.jacobian_pattern());
        let states = unit.model.state_infos().len();
        let place = |wanted: Kind| unit.variables.iter().position(|variable| variable.kind == wanted);
        let inputs: Vec<usize> =
            (0..unit.model.input_count()).filter_map(|k| place(Kind::Input(k))).collect();
        let all_states: Vec<usize> = (0..states).map(|k| unit.states as usize + k).collect();
        let of = |kind: fn(&Kind) -> bool| {
            unit.variables.iter().enumerate().filter(move |(_, variable)| kind(&variable.kind))
        };
        let outputs: Vec<(usize, Option<Vec<usize>>)> = of(|kind| matches!(kind, Kind::Output(_)))
            .map(|(reference, variable)| {
                let Kind::Output(k) = variable.kind else { return (reference, None) };
                let seen = (0..inputs.len()).filter(|input| column(&direct, *input).contains(&k));
                let seen = seen.map(|input| inputs[input]);
                (reference, Some(seen.chain(all_states.iter().copied()).collect()))
            })
            .collect();
        // Temperatures act on all rates, and all powers on them, which the pattern of the derivatives leaves out.
        let warm = unit.model.layout().of_nodes() > 0;
        let rates: Vec<(usize, Option<Vec<usize>>)> = (0..states)
            .map(|row| {
                let over = (0..states).filter(|k| column(&slopes, *k).contains(&row));
                let over_states = over.map(|k| unit.states as usize + k);
                let all = inputs.iter().copied().chain(over_states).collect();
                (unit.rates as usize + row, (!warm).then_some(all))
            })
            .collect();
        let unknown: Vec<(usize, Option<Vec<usize>>)> =
            of(|kind| matches!(kind, Kind::Output(_) | Kind::State(_) | Kind::Rate(_)))
                .map(|(reference, _)| (reference, None))
                .collect();
        self.line("  <ModelStructure>");
        for (group, element, list) in [
            ("Outputs", "Output", outputs),
            ("Derivatives", "ContinuousStateDerivative", rates),
            ("InitialUnknowns", "InitialUnknown", unknown),
        ] {
            if !self.is_three() && !list.is_empty() {
                self.line(&format!("    <{group}>"));
            }
            for (reference, depends) in &list {
                self.unknown(element, *reference, depends.as_deref());
            }
            if !self.is_three() && !list.is_empty() {
                self.line(&format!("    </{group}>"));
            }
        }
        self.line("  </ModelStructure>");
    }

    fn unknown(&mut self, element: &str, reference: usize, depends: Option<&[usize]>) {
        let dependencies = depends.map_or(String::new(), |list| {
            let names: Vec<String> =
                list.iter().map(|reference| self.named(*reference).to_string()).collect();
            format!(" dependencies=\"{}\"", names.join(" "))
        });
        let name = self.named(reference);
        let [element, attribute] =
            if self.is_three() { [element, "valueReference"] } else { ["Unknown", "index"] };
        self.line(&format!("    <{element} {attribute}=\"{name}\"{dependencies}/>"));
    }
}

/// Rows of a column of a pattern.
fn column(pattern: &SparsePattern, k: usize) -> &[usize] {
    &pattern.rows[pattern.column_starts[k]..pattern.column_starts[k + 1]]
}
