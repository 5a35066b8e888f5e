// SPDX-License-Identifier: BSD-3-Clause
//! JSON as the conformance files use it: numbers stay text, so that no bit is lost.
use std::iter::Peekable;
use std::str::Chars;

#[derive(Clone, Debug)]
pub enum Value {
    Bool(bool),
    Number(String),
    Text(String),
    List(Vec<Value>),
    Object(Vec<(String, Value)>),
}

/// Objects are equal if they have the same keys and values: keys have no order.
impl PartialEq for Value {
    fn eq(&self, other: &Value) -> bool {
        match (self, other) {
            (Value::Bool(a), Value::Bool(b)) => a == b,
            (Value::Number(a), Value::Number(b)) | (Value::Text(a), Value::Text(b)) => a == b,
            (Value::List(a), Value::List(b)) => a == b,
            (Value::Object(a), Value::Object(b)) => {
                a.len() == b.len() && a.iter().all(|(name, value)| other.get(name) == Some(value))
            }
            _ => false,
        }
    }
}

impl Value {
    pub fn parse(text: &str) -> Value {
        let mut rest = text.chars().peekable();
        let value = parse(&mut rest);
        assert!(rest.all(char::is_whitespace), "text after the value");
        value
    }

    pub fn get(&self, name: &str) -> Option<&Value> {
        match self {
            Value::Object(fields) => fields.iter().find(|field| field.0 == name).map(|field| &field.1),
            _ => None,
        }
    }

    pub fn text(&self) -> &str {
        match self {
            Value::Text(text) => text,
            other => panic!("no text: {other:?}"),
        }
    }

    pub fn list(&self) -> &[Value] {
        match self {
            Value::List(list) => list,
            other => panic!("no list: {other:?}"),
        }
    }

    /// The value of a constant whose name this text is.
    pub fn constant<T: Copy>(&self, table: &[(&str, T)]) -> T {
        let name = self.text();
        table.iter().find(|entry| entry.0 == name).unwrap_or_else(|| panic!("no constant {name}")).1
    }

    /// The sum of bits whose names this list holds.
    pub fn bits(&self, table: &[(&str, u32)]) -> u32 {
        self.list().iter().fold(0, |sum, name| sum | name.constant(table))
    }

    pub fn from_constant<T: Copy + PartialEq + ToString>(value: T, table: &[(&str, T)]) -> Value {
        match table.iter().find(|entry| entry.1 == value) {
            Some(entry) => Value::Text(entry.0.into()),
            None => Value::Number(value.to_string()),
        }
    }

    pub fn from_bits(value: u32, table: &[(&str, u32)]) -> Value {
        let set = table.iter().filter(|entry| value & entry.1 != 0);
        Value::List(set.map(|entry| Value::Text(entry.0.into())).collect())
    }

    /// A struct with the fields that this object names.
    pub fn fields_over<T: Fields>(&self, mut start: T) -> T {
        match self {
            Value::Object(fields) => {
                for (name, value) in fields {
                    assert!(start.set(name, value), "no field {name}");
                }
            }
            other => panic!("no object: {other:?}"),
        }
        start
    }
}

fn space(rest: &mut Peekable<Chars<'_>>) -> char {
    while rest.next_if(|next| next.is_whitespace()).is_some() {}
    *rest.peek().expect("the text ends too early")
}

/// The elements between two brackets.
fn elements<T>(rest: &mut Peekable<Chars<'_>>, close: char, one: impl Fn(&mut Peekable<Chars<'_>>) -> T) -> Vec<T> {
    let mut all = Vec::new();
    rest.next();
    while space(rest) != close {
        all.push(one(rest));
        if space(rest) == ',' {
            rest.next();
        }
    }
    rest.next();
    all
}

fn parse(rest: &mut Peekable<Chars<'_>>) -> Value {
    match space(rest) {
        '{' => Value::Object(elements(rest, '}', |rest| {
            space(rest);
            let name = string(rest);
            assert_eq!(space(rest), ':');
            rest.next();
            (name, parse(rest))
        })),
        '[' => Value::List(elements(rest, ']', parse)),
        '"' => Value::Text(string(rest)),
        _ => {
            let mut word = String::new();
            while let Some(next) = rest.next_if(|&next| next.is_alphanumeric() || "+-.".contains(next)) {
                word.push(next);
            }
            match word.as_str() {
                "true" | "false" => Value::Bool(word == "true"),
                _ => Value::Number(word),
            }
        }
    }
}

fn string(rest: &mut Peekable<Chars<'_>>) -> String {
    assert_eq!(rest.next(), Some('"'));
    let mut text = String::new();
    loop {
        match rest.next().expect("an open string") {
            '"' => return text,
            '\\' => match rest.next().expect("an open escape") {
                'n' => text.push('\n'),
                't' => text.push('\t'),
                'u' => {
                    let mut unit = || -> u32 {
                        let digits: String = (0..4).map(|_| rest.next().unwrap()).collect();
                        u32::from_str_radix(&digits, 16).unwrap()
                    };
                    text.push(char::from_u32(unit()).expect("a character outside of the basic plane"));
                }
                other => text.push(other),
            },
            other => text.push(other),
        }
    }
}

/// A type with a form in JSON.
pub trait Json: Sized {
    fn read(value: &Value) -> Self;
    fn write(&self) -> Value;
}

/// A struct whose fields have names.
pub trait Fields {
    fn set(&mut self, name: &str, value: &Value) -> bool;
    fn get(&self) -> Vec<(String, Value)>;
}

/// What a field is that nobody names.
pub trait Zero {
    fn zero() -> Self;
}

impl Json for f64 {
    fn read(value: &Value) -> Self {
        match value {
            Value::Number(text) => text.parse().unwrap(),
            Value::Text(text) => match text.strip_prefix('x') {
                Some(bits) => f64::from_bits(u64::from_str_radix(bits, 16).unwrap()),
                None => text.parse().unwrap(), // nan, inf, -inf
            },
            other => panic!("no number: {other:?}"),
        }
    }

    fn write(&self) -> Value {
        Value::Text(if self.is_nan() { "nan".into() } else { format!("x{:016x}", self.to_bits()) })
    }
}

impl Json for u64 {
    fn read(value: &Value) -> Self {
        value.text().parse().unwrap()
    }

    fn write(&self) -> Value {
        Value::Text(self.to_string())
    }
}

impl Json for bool {
    fn read(value: &Value) -> Self {
        matches!(value, Value::Bool(true))
    }

    fn write(&self) -> Value {
        Value::Bool(*self)
    }
}

macro_rules! small_integers {
    ($($integer:ty),*) => {$(
        impl Json for $integer {
            fn read(value: &Value) -> Self {
                match value {
                    Value::Number(text) => text.parse().unwrap(),
                    other => panic!("no integer: {other:?}"),
                }
            }

            fn write(&self) -> Value {
                Value::Number(self.to_string())
            }
        }
    )*};
}
small_integers!(i32, u32, usize);

macro_rules! zeros {
    ($($number:ty: $zero:expr),*) => {$(
        impl Zero for $number {
            fn zero() -> Self {
                $zero
            }
        }
    )*};
}
zeros!(f64: 0.0, u64: 0, i32: 0, u32: 0, bool: false);

impl<T: Zero + Copy, const N: usize> Zero for [T; N] {
    fn zero() -> Self {
        [T::zero(); N]
    }
}

impl<T: Json, const N: usize> Json for [T; N] {
    fn read(value: &Value) -> Self {
        let all: Vec<T> = Json::read(value);
        all.try_into().unwrap_or_else(|all: Vec<T>| panic!("{} elements instead of {N}", all.len()))
    }

    fn write(&self) -> Value {
        Value::List(self.iter().map(Json::write).collect())
    }
}

impl<T: Json> Json for Vec<T> {
    fn read(value: &Value) -> Self {
        value.list().iter().map(T::read).collect()
    }

    fn write(&self) -> Value {
        Value::List(self.iter().map(Json::write).collect())
    }
}

/// A text, and bytes as `bytes:00ff`.
impl Json for String {
    fn read(value: &Value) -> Self {
        value.text().into()
    }

    fn write(&self) -> Value {
        Value::Text(self.clone())
    }
}

pub fn bytes(value: &Value) -> Vec<u8> {
    let digits = value.text().strip_prefix("bytes:").expect("no bytes");
    (0..digits.len() / 2).map(|i| u8::from_str_radix(&digits[2 * i..2 * i + 2], 16).unwrap()).collect()
}

pub fn from_bytes(bytes: &[u8]) -> Value {
    Value::Text(bytes.iter().fold("bytes:".into(), |text, byte| format!("{text}{byte:02x}")))
}
