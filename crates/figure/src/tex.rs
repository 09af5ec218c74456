//! Words as LaTeX writes them.

/// Text with the characters that mean something in LaTeX written out.
#[must_use]
pub fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '\\' => out.push_str(r"\textbackslash{}"),
            '~' => out.push_str(r"\textasciitilde{}"),
            '^' => out.push_str(r"\textasciicircum{}"),
            '%' | '_' | '&' | '#' | '$' | '{' | '}' => {
                out.push('\\');
                out.push(c);
            }
            c if c.is_control() => out.push(' '),
            c => match in_math(c) {
                Some(name) => {
                    out.push('$');
                    out.push_str(name);
                    out.push('$');
                }
                None => out.push(c),
            },
        }
    }
    out
}

/// A text as it stands inside a formula.
#[must_use]
pub fn formula(text: &str) -> String {
    text.chars()
        .map(|c| match in_math(c) {
            Some(name) => format!("{name} "),
            None if c.is_ascii_alphanumeric() || c == '.' || c == '-' => c.to_string(),
            None => format!(r"\text{{{}}}", escaped(&c.to_string())),
        })
        .collect::<String>()
        .trim_end()
        .to_owned()
}

/// The command of a character that only a formula has.
fn in_math(c: char) -> Option<&'static str> {
    Some(match c {
        'ζ' => r"\zeta",
        'θ' => r"\theta",
        'ϑ' => r"\vartheta",
        'δ' => r"\delta",
        'σ' => r"\sigma",
        'φ' => r"\varphi",
        'ẋ' => r"\dot{x}",
        'ẍ' => r"\ddot{x}",
        'ÿ' => r"\ddot{y}",
        'μ' => r"\mu",
        'ω' => r"\omega",
        '−' => "-",
        '·' => r"\cdot",
        '°' => r"^\circ",
        _ => return None,
    })
}
