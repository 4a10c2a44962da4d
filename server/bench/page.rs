//! The report as a page that needs nothing beside itself.

use super::{
    plots::plots,
    report::Report,
    table::{FIGURES, HEAD, cells},
};
use crate::commands::Failure;
use maud::{DOCTYPE, Markup, PreEscaped, html};

const STYLE: &str = "body{font:14px/1.5 sans-serif;margin:2em;color:#222}\
    table{border-collapse:collapse;margin:1em 0}\
    th,td{padding:.15em .7em;border-bottom:1px solid #ddd;text-align:left;vertical-align:top}\
    .figure{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}\
    .missed{color:#a00}\
    .plots{display:flex;flex-wrap:wrap;gap:1em}";

/// The page's HTML.
///
/// # Errors
/// Where a plot cannot be drawn.
pub(crate) fn page(report: &Report) -> Result<String, Failure> {
    let plots = plots(report)?;
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width";
                title { "Welkin: what frames cost" }
                style { (PreEscaped(STYLE)) }
            }
            body {
                h1 { "What frames cost" }
                @for line in report.head() { p { (line) } }
                @if let Some(reason) = &report.baseline_absent { p { "No baseline: " (reason) } }
                @for fault in &report.faults { p.missed { (fault) } }
                // Drawn by us a line above; its texts are escaped there.
                div.plots { @for plot in &plots { (PreEscaped(plot)) } }
                (rows(report))
            }
        }
    };
    Ok(page.into_string())
}

fn rows(report: &Report) -> Markup {
    let class = |column| if FIGURES.contains(&column) { "figure" } else { "" };
    html! {
        table {
            tr { @for (column, name) in HEAD.iter().enumerate() { th class=(class(column)) { (name) } } }
            @for row in &report.rows {
                tr.missed[row.misses()] {
                    @for (column, cell) in cells(row).iter().enumerate() { td class=(class(column)) { (cell) } }
                }
            }
        }
    }
}
