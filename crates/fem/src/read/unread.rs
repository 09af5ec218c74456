//! Cards of an `.inp` file that are not read: which of them change the model, and what to do instead.

use super::cards::Card;
use crate::Error;

/// Cards that change the model, with what they do and what to do instead. A file with one of them is refused.
const CHANGING: [(&[&str], &str); 10] = [
    (
        &[
            "EQUATION",
            "MPC",
            "RIGID BODY",
            "COUPLING",
            "KINEMATIC",
            "DISTRIBUTING",
            "KINEMATIC COUPLING",
            "DISTRIBUTING COUPLING",
            "SHELL TO SOLID COUPLING",
            "EMBEDDED ELEMENT",
            "CYCLIC SYMMETRY MODEL",
            "PRE-TENSION SECTION",
        ],
        "ties displacements to one another; join surfaces by *TIE or [[bonds]], hold nodes by *BOUNDARY or [[supports]]",
    ),
    (
        &["CONTACT PAIR", "CONTACT", "GAP", "GAP UNIT"],
        "lets surfaces touch; describe surfaces that slide as [[sliding]] and bonded ones as [[bonds]]",
    ),
    (&["TRANSFORM", "SYSTEM"], "turns axes; write coordinates and supports along the global axes"),
    (
        &["SPRING", "DASHPOT", "FOUNDATION", "CONNECTOR SECTION", "CONNECTOR BEHAVIOR", "BUSHING"],
        "adds stiffness or damping between nodes; make it a solid body, or a support",
    ),
    (
        &["MASS", "ROTARY INERTIA", "POINT MASS", "NONSTRUCTURAL MASS"],
        "adds mass at nodes; make it a solid body, or add it to the density of one",
    ),
    (
        &["DAMPING", "MODAL DAMPING", "GLOBAL DAMPING"],
        "damps; give `rayleigh` or `loss_factor` to a material of the description, or `damping_ratios`",
    ),
    (
        &["INITIAL CONDITIONS"],
        "gives the bodies a state before the load; load them in the description, whose `temperature` is that of its materials",
    ),
    (
        &[
            "SHELL SECTION",
            "MEMBRANE SECTION",
            "BEAM SECTION",
            "BEAM GENERAL SECTION",
            "SHELL GENERAL SECTION",
        ],
        "makes bodies of lines or surfaces; mesh them with solid elements",
    ),
    (
        &["NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY"],
        "makes nodes or elements from others; write them one by one",
    ),
    (&["CLOAD", "DLOAD", "DSLOAD"], "loads the bodies; describe it as [[loads]]"),
];

/// Loads of a step: the analysis of another program, of which only the supports count here.
const LOADS: [&str; 8] = [
    "CLOAD",
    "DLOAD",
    "DSLOAD",
    "TEMPERATURE",
    "BASE MOTION",
    "PRE-TENSION",
    "MODEL CHANGE",
    "CHANGE FRICTION",
];

/// Cards that change nothing in a mesh and its linear elastic materials without being in a step.
const HARMLESS: [&str; 23] = [
    "HEADING",
    "PREPRINT",
    "AMPLITUDE",
    "RESTART",
    "PHYSICAL CONSTANTS",
    "TIME POINTS",
    "OUTPUT",
    "FILTER",
    "STEP",
    "END STEP",
    "PART",
    "END PART",
    "ASSEMBLY",
    "END ASSEMBLY",
    "INSTANCE",
    "END INSTANCE",
    "EXPANSION",
    "CONDUCTIVITY",
    "SPECIFIC HEAT",
    "ORIENTATION",
    "SURFACE INTERACTION",
    "SURFACE BEHAVIOR",
    "FRICTION",
];

/// Cards of a step that say how to compute.
const OF_A_STEP: [&str; 18] = [
    "STATIC",
    "FREQUENCY",
    "COMPLEX FREQUENCY",
    "STEADY STATE DYNAMICS",
    "DYNAMIC",
    "MODAL DYNAMIC",
    "BUCKLE",
    "VISCO",
    "HEAT TRANSFER",
    "COUPLED TEMPERATURE-DISPLACEMENT",
    "UNCOUPLED TEMPERATURE-DISPLACEMENT",
    "CONTROLS",
    "CONTACT CONTROLS",
    "SOLVER CONTROLS",
    "SOLUTION TECHNIQUE",
    "SELECT EIGENMODES",
    "MONITOR",
    "NO PRINT",
];

/// Parameters of cards that are read, which are not and change the model, with what to do.
const PARAMETERS: [(&str, &str, &str); 8] = [
    (
        "SOLID SECTION",
        "ORIENTATION",
        "leave it out where the material is isotropic, else turn the mesh to its axes",
    ),
    ("NODE", "SYSTEM", "write coordinates along the global axes"),
    ("NODE", "INPUT", "put the file's lines here"),
    ("ELEMENT", "INPUT", "put the file's lines here"),
    ("TIE", "CYCLIC SYMMETRY", "model the whole body"),
    ("TIE", "MULTISTAGE", "model the whole body"),
    ("BOUNDARY", "SUBMODEL", "give the displacements as numbers"),
    ("SOLID SECTION", "COMPOSITE", "give each layer elements and a section of its own"),
];

/// What becomes of a card that is not read: nothing where it changes nothing, a remark where nothing is known of it.
///
/// # Errors
/// Where it changes the model, with what to do instead.
pub(super) fn passed_over(card: &Card<'_>, in_step: bool) -> Result<Option<String>, Error> {
    let Card { name, line, .. } = card;
    if in_step && LOADS.contains(&name.as_str()) {
        let remark = "belongs to a step and is left out: the loads of a study are its [[loads]]";
        return Ok(Some(format!("line {line}: *{name} {remark}")));
    }
    if let Some((_, what)) = CHANGING.iter().find(|(names, _)| names.contains(&name.as_str())) {
        let (does, instead) = what.split_once("; ").unwrap_or((what, "leave it out"));
        let what = format!("*{name} {does}, which is not read from this file: leave it out and {instead}");
        return Err(Error::File { line: *line, what });
    }
    let known = HARMLESS.contains(&name.as_str()) || in_step && OF_A_STEP.contains(&name.as_str());
    let known = known || name.ends_with(" PRINT");
    let known = known || [" FILE", " OUTPUT"].iter().any(|end| name.ends_with(end));
    Ok((!known).then(|| format!("line {line}: *{name} is not known here and is left out")))
}

/// Refuses several parts, whose nodes have the same numbers, such as are moved, and nodes of the assembly itself, which have numbers of their own.
pub(super) fn check_parts(cards: &[Card<'_>]) -> Result<(), Error> {
    let another = cards.iter().filter(|card| card.name == "PART").nth(1);
    let moved = cards.iter().find(|card| card.name == "INSTANCE" && !card.data.is_empty());
    let mut in_assembly = false;
    for card in cards {
        match card.name.as_str() {
            "ASSEMBLY" => in_assembly = true,
            "END ASSEMBLY" => in_assembly = false,
            "NODE" | "ELEMENT" if in_assembly && !card.of_part => {
                let what = format!(
                    "*{} of the assembly is numbered apart from those of its part, which is not read: leave it out, such as reference points, or \
                     export the model without parts",
                    card.name
                );
                return Err(Error::File { line: card.line, what });
            }
            _ => {}
        }
    }
    let Some(card) = another.or(moved) else { return Ok(()) };
    let what = format!(
        "*{} makes a model of several parts or moves one, which is not read: export it without parts, or each part as a file of its own",
        card.name
    );
    Err(Error::File { line: card.line, what })
}

/// Refuses supports that take the place of those of an earlier step.
pub(super) fn check_new(card: &Card<'_>, after_others: bool) -> Result<(), Error> {
    if !(after_others && card.parameters.get("OP").is_some_and(|op| op == "NEW")) {
        return Ok(());
    }
    let what = "OP=NEW of *BOUNDARY takes away what earlier steps hold, which is not followed: keep the supports of one step only";
    Err(Error::File { line: card.line, what: what.to_owned() })
}

/// Refuses what changes the model in the parameters of a card that is read.
pub(super) fn check_parameters(card: &Card<'_>) -> Result<(), Error> {
    let wrong = |what: String| Err(Error::File { line: card.line, what });
    let found = PARAMETERS
        .iter()
        .find(|(name, parameter, _)| card.name == *name && card.parameters.contains_key(*parameter));
    if let Some((name, parameter, instead)) = found {
        return wrong(format!("{parameter} of *{name} is not read: {instead}"));
    }
    match card.parameters.get("TYPE").map(String::as_str) {
        Some(kind) if card.name == "BOUNDARY" && kind != "DISPLACEMENT" => {
            wrong(format!("TYPE={kind} of *BOUNDARY is not read: displacements are"))
        }
        _ => Ok(()),
    }
}
