//! The commands `completions` and `man`: what a shell and its manual say of the tool, made from the definition of its arguments.

use crate::results::files::{file_error, write_text};
use crate::{Cli, CompletionsArgs, ManArgs, terminal};
use cagedyn::{Error, Result, Status};
use clap::{Command, CommandFactory};
use clap_mangen::Man;
use std::io;
use std::process::ExitCode;

/// Prints the completions of a shell.
///
/// # Errors
/// [`Status::File`] when standard output cannot be written.
pub fn completions(args: &CompletionsArgs) -> Result<ExitCode> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut Cli::command(), "cagedyn", &mut script);
    terminal::print(&String::from_utf8_lossy(&script))?;
    Ok(ExitCode::SUCCESS)
}

/// Prints one manual page of all commands, or writes a page for each into a folder.
///
/// # Errors
/// [`Status::File`] for what cannot be written.
pub fn man(args: &ManArgs) -> Result<ExitCode> {
    let mut tool = Cli::command();
    // Names the commands as they are called, `cagedyn run`, and gives them the options of all.
    tool.build();
    let Some(folder) = &args.out else {
        terminal::print(&one_page(&tool)?)?;
        return Ok(ExitCode::SUCCESS);
    };
    std::fs::create_dir_all(folder).map_err(|e| file_error(folder, e))?;
    let commands = tool.get_subcommands().filter(|command| command.get_name() != "help");
    for command in [&tool].into_iter().chain(commands) {
        let name = command.get_display_name().unwrap_or_else(|| command.get_name());
        let page = rendered(|out| page_of(command).render(out))? + EXIT_STATUS;
        write_text(&folder.join(format!("{name}.1")), &page)?;
    }
    Ok(ExitCode::SUCCESS)
}

/// How commands end, for the manual.
const EXIT_STATUS: &str = ".SH \"EXIT STATUS\"\n0 complete and trusted, 1 failed, 2 wrong arguments, 3 complete but not to be trusted, \
                           130 interrupted.\n";

fn page_of(command: &Command) -> Man {
    Man::new(command.clone()).source(concat!("cagedyn ", env!("CARGO_PKG_VERSION")))
}

/// The page of the tool with a section for every command.
fn one_page(tool: &Command) -> Result<String> {
    let mut page = rendered(|out| page_of(tool).render(out))?;
    for command in tool.get_subcommands().filter(|command| command.get_name() != "help") {
        let man = page_of(command);
        let text = rendered(|out| {
            man.render_synopsis_section(out)?;
            man.render_description_section(out)?;
            man.render_options_section(out)
        })?;
        page.push_str(&format!(".SH \"CAGEDYN {}\"\n", command.get_name().to_uppercase()));
        page.push_str(&text.replace(".SH ", ".SS "));
    }
    Ok(page + EXIT_STATUS)
}

fn rendered(render: impl FnOnce(&mut dyn io::Write) -> io::Result<()>) -> Result<String> {
    let mut page = Vec::new();
    render(&mut page).map_err(|e| Error::new(Status::Internal, format!("manual page: {e}")))?;
    Ok(String::from_utf8_lossy(&page).into_owned())
}
