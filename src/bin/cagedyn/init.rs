//! The command `init`: a starter scene with comments.

use crate::results::files::write_text;
use crate::{InitArgs, terminal};
use cagedyn::{Error, Result, Status};
use clap::ValueEnum;
use std::process::ExitCode;

/// Kinds of bearings that there is a starter for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Kind {
    /// Cylindrical rollers that move freely, an inner ring under load, a cage on the outer ring in oil.
    CylindricalRoller,
    /// Balls that roll without slip, a cage on a grease layer of the outer ring.
    GreasedBall,
    /// The same in a guide full of oil.
    OiledBall,
    /// Balls that move freely in space, angular contact, an inner ring under combined load; no cage.
    AngularContact,
    /// The same with a cage that tilts, on two lands of the outer ring.
    AngularContactCage,
    /// Balls that move freely in a deep groove bearing; no cage.
    DeepGroove,
}

impl Kind {
    /// The starter scene.
    pub fn text(self) -> &'static str {
        match self {
            Self::CylindricalRoller => include_str!("starters/cylindrical-roller.json"),
            Self::GreasedBall => include_str!("starters/greased-ball.json"),
            Self::OiledBall => include_str!("starters/oiled-ball.json"),
            Self::AngularContact => include_str!("starters/angular-contact.json"),
            Self::AngularContactCage => include_str!("starters/angular-contact-cage.json"),
            Self::DeepGroove => include_str!("starters/deep-groove.json"),
        }
    }
}

/// Writes a starter scene; a file that is there is left alone.
///
/// # Errors
/// [`Status::File`] for a file that exists or cannot be written.
pub fn command(args: &InitArgs) -> Result<ExitCode> {
    let Some(out) = &args.out else {
        terminal::print(args.kind.text())?;
        return Ok(ExitCode::SUCCESS);
    };
    if out.exists() {
        let text = format!("{}: is there already; choose another name", out.display());
        return Err(Error::new(Status::File, text));
    }
    write_text(out, args.kind.text())?;
    terminal::print(&format!("{0}: change it, then `cagedyn run {0} --out out`\n", out.display()))?;
    Ok(ExitCode::SUCCESS)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_starter_is_a_scene_with_comments() {
        for kind in Kind::value_variants() {
            cagedyn::Model::from_json(kind.text()).unwrap_or_else(|e| panic!("{kind:?}: {e}"));
            assert!(kind.text().matches("\"comment\"").count() > 4, "{kind:?}");
        }
    }
}
