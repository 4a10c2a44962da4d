//! What the schema finds wrong, in words. Where a value may be one of several shapes, the shape that its author meant
//! is found and its faults are told, rather than that none fits.
//!
//! The work is bounded by the number of problems reported, whatever the size of the document.

use crate::{
    problem::{Problem, Problems, echo, label, member},
    shape::{TAG, branches, describe, fields, is_of_type, members, one_of, resolve, tags, words},
};
use serde_json::{Value, json};

/// Names less alike than this are not taken for one another.
const ALIKE: f64 = 0.5;

/// Adds what is wrong with `held`, which stands at `pointer`, by `schema`, which stands in `root`.
pub(crate) fn explain(root: &Value, schema: &Value, pointer: &str, held: &Value, problems: &mut Problems) {
    let schema = resolve(root, schema);
    if !branches(schema).is_empty() {
        return explain_union(root, schema, pointer, held, problems);
    }
    let wrong_word = schema.get("const").is_some_and(|word| word != held);
    if !is_of_type(schema, held) || wrong_word || is_out_of_range(schema, held) || is_misspelt(schema, held) {
        return problems.push(misfit(root, schema, pointer, held));
    }
    match held {
        Value::Array(items) => {
            for (i, item) in items.iter().enumerate() {
                if problems.is_full() {
                    return;
                }
                explain(root, &schema["items"], &format!("{pointer}/{i}"), item, problems);
            }
        }
        Value::Object(held) => {
            // Anything goes, as in a patch.
            let Some(known) = schema.get("properties") else {
                return;
            };
            for (name, value) in held {
                if problems.is_full() {
                    return;
                }
                match known.get(name) {
                    Some(schema) => explain(root, schema, &member(pointer, name), value, problems),
                    None => problems.push(unknown(schema, pointer, name, value)),
                }
            }
            for name in schema["required"]
                .as_array()
                .into_iter()
                .flatten()
                .filter_map(Value::as_str)
            {
                let is_there_misspelt = || {
                    held.keys()
                        .any(|k| known.get(k).is_none() && nearest(k, &members(schema)) == Some(name))
                };
                if !held.contains_key(name) && !is_there_misspelt() {
                    let allowed = describe(root, &known[name], &member(pointer, name));
                    problems.push(missing(pointer, name, allowed));
                }
            }
        }
        _ => {}
    }
}

fn explain_union(root: &Value, schema: &Value, pointer: &str, held: &Value, problems: &mut Problems) {
    match choose(root, schema, held) {
        Choice::Branch(branch) => explain(root, branch, pointer, held, problems),
        Choice::Tag => {
            let known = tags(root, schema);
            problems.push(match held.get(TAG) {
                Some(found) => with_guess(
                    Problem::new(member(pointer, TAG), found, one_of(&known)),
                    found,
                    &known,
                ),
                None => missing(pointer, TAG, one_of(&known)),
            });
        }
        Choice::None => problems.push(misfit(root, schema, pointer, held)),
    }
}

/// A number beyond its range or an array of the wrong length.
fn is_out_of_range(schema: &Value, held: &Value) -> bool {
    let (size, least, most) = match held {
        Value::Number(n) => (n.as_f64(), "minimum", "maximum"),
        Value::Array(items) => (Some(items.len() as f64), "minItems", "maxItems"),
        _ => return false,
    };
    let beyond = |limit: &str, is_beyond: fn(&f64, &f64) -> bool| {
        size.zip(schema[limit].as_f64())
            .is_some_and(|(size, limit)| is_beyond(&size, &limit))
    };
    beyond(least, f64::lt) || beyond(most, f64::gt)
}

/// A text that does not match its pattern.
fn is_misspelt(schema: &Value, held: &Value) -> bool {
    let pattern = schema.get("pattern").filter(|_| held.is_string());
    pattern.is_some_and(|pattern| !jsonschema::is_valid(&json!({ "pattern": pattern }), held))
}

fn misfit(root: &Value, schema: &Value, pointer: &str, held: &Value) -> Problem {
    let problem = Problem::new(pointer.into(), held, describe(root, schema, pointer));
    with_guess(problem, held, &words(root, schema))
}

fn unknown(schema: &Value, parent: &str, name: &str, held: &Value) -> Problem {
    let known = members(schema);
    let Some(name) = echo(name) else {
        let mut problem = Problem::new(parent.into(), &Value::Null, fields(&known));
        problem.message = format!("{} has an unknown field with a very long name", label(parent));
        return problem;
    };
    let mut problem = Problem::new(member(parent, name), held, fields(&known));
    problem.message = match nearest(name, &known) {
        Some(guess) => format!("unknown field `{name}`; did you mean `{guess}`?"),
        None => format!("unknown field `{name}`;"),
    };
    problem
        .message
        .push_str(&format!(" {} has {}", label(parent), problem.allowed));
    problem
}

fn missing(parent: &str, name: &str, allowed: String) -> Problem {
    let mut problem = Problem::new(member(parent, name), &Value::Null, allowed);
    problem.message = format!(
        "{} lacks the field `{name}`, which must be {}",
        label(parent),
        problem.allowed
    );
    problem
}

fn with_guess(mut problem: Problem, found: &Value, known: &[&str]) -> Problem {
    if let Some(guess) = found.as_str().and_then(|found| nearest(found, known)) {
        problem.message.push_str(&format!("; did you mean `{guess}`?"));
    }
    problem
}

enum Choice<'a> {
    Branch(&'a Value),
    /// None, for the tag is missing or wrong.
    Tag,
    None,
}

/// The branch of a union that the author of `held` meant.
fn choose<'a>(root: &'a Value, schema: &'a Value, held: &Value) -> Choice<'a> {
    let branches = branches(schema);
    if let Some(word) = branches
        .iter()
        .find(|b| b.get("const").is_some_and(|word| word == held))
    {
        return Choice::Branch(word);
    }
    if branches.iter().all(|b| b.get("const").is_some()) {
        return Choice::None;
    }
    if held.is_object() && !tags(root, schema).is_empty() {
        let meant = branches
            .iter()
            .find(|b| resolve(root, b)["properties"][TAG]["const"] == held[TAG]);
        return meant.map_or(Choice::Tag, Choice::Branch);
    }
    let mut fitting: Vec<_> = branches
        .iter()
        .filter_map(|b| Some((fit(root, b, held)?, b)))
        .collect();
    fitting.sort_by(|a, b| b.0.total_cmp(&a.0));
    match fitting[..] {
        [(_, only)] => Choice::Branch(only),
        [(score, best), ..] if score > 0.0 => Choice::Branch(best),
        _ => Choice::None,
    }
}

/// How well a value fits a schema: none if its type is another, else about how many of its members are known.
fn fit(root: &Value, schema: &Value, held: &Value) -> Option<f64> {
    let schema = resolve(root, schema);
    if !branches(schema).is_empty() {
        return branches(schema)
            .iter()
            .filter_map(|b| fit(root, b, held))
            .reduce(f64::max);
    }
    if !is_of_type(schema, held) {
        return None;
    }
    let Some(held) = held.as_object() else {
        return Some(1.0);
    };
    let known = members(schema);
    // The first members tell; a hostile object may have millions.
    let best = |name: &String| known.iter().map(|k| likeness(name, k)).fold(0.0, f64::max);
    Some(
        held.keys()
            .take(known.len())
            .map(best)
            .filter(|&s| s >= ALIKE)
            .sum(),
    )
}

fn nearest<'a>(name: &str, known: &[&'a str]) -> Option<&'a str> {
    let (likeness, nearest) = known
        .iter()
        .map(|k| (likeness(name, k), *k))
        .max_by(|a, b| a.0.total_cmp(&b.0))?;
    (likeness >= ALIKE).then_some(nearest)
}

/// 1 for the same name; a part of the name, as without its unit, counts much.
fn likeness(name: &str, known: &str) -> f64 {
    let Some(name) = echo(name) else { return 0.0 };
    if name == known {
        1.0
    } else if name.len() > 2 && (name.contains(known) || known.contains(name)) {
        0.9
    } else {
        strsim::normalized_damerau_levenshtein(name, known)
    }
}
