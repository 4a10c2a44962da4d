//! What the clouds' frames cost by what is varied, as small plots.

use super::report::{Report, Row};
use crate::commands::Failure;
use plotters::{
    coord::ranged1d::{AsRangedCoord, ValueFormatter},
    prelude::*,
};

/// A plot of processor time, or where the system does not tell it, of time on the clock.
#[derive(Debug, PartialEq)]
struct Plot {
    title: &'static str,
    across: &'static str,
    /// Both axes by powers of ten; else both from 0.
    logarithmic: bool,
    lines: Vec<Line>,
}

#[derive(Debug, PartialEq)]
struct Line {
    name: String,
    /// From left to right.
    points: Vec<(f64, f64)>,
}

/// Table, title, field that is varied, and what stands below the axis.
const TABLES: [(&str, &str, &str, &str); 5] = [
    ("shell-density", "By density", "density", "density"),
    (
        "shell-coverage",
        "By coverage, in the shell",
        "coverage",
        "coverage",
    ),
    ("steps", "By steps along the ray of view", "steps", "steps"),
    ("coverage", "By coverage", "coverage", "coverage"),
    (
        "light-steps",
        "By steps to the light",
        "light_steps",
        "light steps",
    ),
];

const SIZE_PX: (u32, u32) = (460, 300);

/// Each plot as SVG; those for which nothing was measured are left out.
///
/// # Errors
/// Where one cannot be drawn.
pub(super) fn plots(report: &Report) -> Result<Vec<String>, Failure> {
    let by_size = Plot {
        title: "By size, sun moved",
        across: "megapixels",
        logarithmic: true,
        lines: by_size(&report.rows),
    };
    let tables = TABLES.map(|(table, title, field, across)| Plot {
        title,
        across,
        logarithmic: false,
        lines: by_field(&report.rows, table, field),
    });
    std::iter::once(by_size)
        .chain(tables)
        .filter(|plot| plot.lines.iter().any(|line| line.points.len() > 1))
        .map(|plot| svg(&plot))
        .collect()
}

fn cost_ms(row: &Row) -> f64 {
    row.spent.cpu_ms.unwrap_or(row.spent.wall_ms)
}

/// The rows of one table of the clouds.
fn of_table<'a>(rows: &'a [Row], table: &str) -> impl Iterator<Item = &'a Row> {
    rows.iter().filter(move |row| {
        row.case == "clouds"
            && row
                .setup
                .parameters
                .get("table")
                .is_some_and(|name| name == table)
    })
}

fn by_field(rows: &[Row], table: &str, field: &str) -> Vec<Line> {
    let mut lines = Vec::new();
    for row in of_table(rows, table) {
        if let Some(x) = row.varied.get(field).and_then(serde_json::Value::as_f64) {
            add(&mut lines, &quality(row), x, cost_ms(row));
        }
    }
    sorted(lines)
}

fn by_size(rows: &[Row]) -> Vec<Line> {
    let mut lines = Vec::new();
    let measured = of_table(rows, "changes").chain(of_table(rows, "shell-size"));
    for row in measured.filter(|row| row.work == "sun-moved") {
        let size = row.setup.size;
        let megapixels = f64::from(size.width_px) * f64::from(size.height_px) * 1e-6;
        add(&mut lines, &quality(row), megapixels, cost_ms(row));
        for baseline in &row.baselines {
            let ms = baseline.spent.cpu_ms.unwrap_or(baseline.spent.wall_ms);
            add(&mut lines, baseline.case, megapixels, ms);
        }
    }
    sorted(lines)
}

fn quality(row: &Row) -> String {
    let quality = row.setup.parameters.get("quality");
    quality
        .and_then(serde_json::Value::as_str)
        .unwrap_or_default()
        .to_owned()
}

/// One point for each place: a baseline stands in several rows of a size.
fn add(lines: &mut Vec<Line>, name: &str, x: f64, y: f64) {
    let at = lines
        .iter()
        .position(|line| line.name == name)
        .unwrap_or_else(|| {
            lines.push(Line {
                name: name.to_owned(),
                points: Vec::new(),
            });
            lines.len() - 1
        });
    let points = &mut lines[at].points;
    if !points.iter().any(|known| known.0.total_cmp(&x).is_eq()) {
        points.push((x, y));
    }
}

fn sorted(mut lines: Vec<Line>) -> Vec<Line> {
    for line in &mut lines {
        line.points.sort_by(|a, b| a.0.total_cmp(&b.0));
    }
    lines
}

fn svg(plot: &Plot) -> Result<String, Failure> {
    let mut text = String::new();
    let all = || plot.lines.iter().flat_map(|line| &line.points);
    let most = |of: fn(&(f64, f64)) -> f64| all().map(of).fold(0.0, f64::max);
    let least = |of: fn(&(f64, f64)) -> f64| all().map(of).fold(f64::INFINITY, f64::min);
    let (x, y) = (|p: &(f64, f64)| p.0, |p: &(f64, f64)| p.1);
    let drawn = if plot.logarithmic {
        // A little room, and no axis from 0.
        let range = |least: f64, most: f64| (0.8 * least.max(1e-3)..1.25 * most).log_scale();
        draw(
            &mut text,
            plot,
            range(least(x), most(x)),
            range(least(y), most(y)),
        )
    } else {
        // Above the lines there is room for their names.
        draw(&mut text, plot, 0.0..1.05 * most(x), 0.0..1.5 * most(y))
    };
    drawn.map_err(|e| Failure::Bench(format!("the plot {:?}: {e}", plot.title)))?;
    Ok(text)
}

fn draw<X, Y>(
    text: &mut String,
    plot: &Plot,
    across: X,
    up: Y,
) -> Result<(), DrawingAreaErrorKind<std::io::Error>>
where
    X: AsRangedCoord<Value = f64>,
    Y: AsRangedCoord<Value = f64>,
    X::CoordDescType: ValueFormatter<f64>,
    Y::CoordDescType: ValueFormatter<f64>,
{
    let area = SVGBackend::with_string(text, SIZE_PX).into_drawing_area();
    area.fill(&WHITE)?;
    let mut chart = ChartBuilder::on(&area)
        .caption(plot.title, ("sans-serif", 16))
        .margin(10)
        .x_label_area_size(36)
        .y_label_area_size(56)
        .build_cartesian_2d(across, up)?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .x_desc(plot.across)
        .y_desc("ms a frame")
        .draw()?;
    for (at, line) in plot.lines.iter().enumerate() {
        let style = Palette99::pick(at).stroke_width(2);
        chart
            .draw_series(LineSeries::new(line.points.iter().copied(), style).point_size(3))?
            .label(&line.name)
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 16, y)], style));
    }
    let names = if plot.logarithmic {
        SeriesLabelPosition::LowerRight
    } else {
        SeriesLabelPosition::UpperLeft
    };
    chart
        .configure_series_labels()
        .position(names)
        .background_style(WHITE.mix(0.8))
        .border_style(BLACK.mix(0.3))
        .draw()?;
    area.present()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

    use super::*;

    #[test]
    fn points_stand_once_and_from_left_to_right() {
        let mut lines = Vec::new();
        for (name, x, y) in [
            ("final", 3.0, 9.0),
            ("preview", 3.0, 1.0),
            ("final", 1.0, 5.0),
            ("final", 3.0, 7.0),
        ] {
            add(&mut lines, name, x, y);
        }
        let lines = sorted(lines);
        assert_eq!(lines.len(), 2);
        assert_eq!(lines[0].points, [(1.0, 5.0), (3.0, 9.0)]);
        assert_eq!(lines[1].points, [(3.0, 1.0)]);
    }

    #[test]
    fn a_plot_names_its_axes_and_lines_and_draws_higher_what_costs_more() {
        let plot = |logarithmic| Plot {
            title: "By something",
            across: "some <unit>",
            logarithmic,
            lines: vec![
                Line {
                    name: "dear".to_owned(),
                    points: vec![(1.0, 100.0), (2.0, 100.0)],
                },
                Line {
                    name: "cheap".to_owned(),
                    points: vec![(1.0, 10.0), (2.0, 10.0)],
                },
            ],
        };
        for logarithmic in [false, true] {
            let text = svg(&plot(logarithmic)).unwrap();
            assert!(
                text.starts_with("<svg") && text.trim_end().ends_with("</svg>"),
                "{text}"
            );
            for word in ["By something", "some &lt;unit&gt;", "ms a frame", "dear", "cheap"] {
                assert!(text.contains(word), "{word}");
            }
            // The points' circles; pixels are counted from the top.
            let heights: Vec<i32> = text
                .split("<circle ")
                .skip(1)
                .filter_map(|circle| circle.split("cy=\"").nth(1)?.split('"').next()?.parse().ok())
                .collect();
            assert_eq!(heights.len(), 4, "{text}");
            assert!(
                heights[0] == heights[1] && heights[2] == heights[3],
                "{heights:?}"
            );
            assert!(heights[0] < heights[2], "{heights:?}");
        }
    }
}
