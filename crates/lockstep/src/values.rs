//! Values and expressions: which registers they are in, and the operations that put them there.

use std::collections::HashMap;

use naga::proc::TypeResolution;
use naga::valid::{FunctionInfo, ModuleInfo};
use naga::{
    Arena, Expression, Function, Handle, Literal, LocalVariable, MathFunction, Module, RelationalFunction,
    ScalarKind, Type, TypeInner, UnaryOperator,
};

use crate::code::{CONSTANTS, Node};
use crate::operation::{Does, Kind, Operation};

pub(crate) type Result<T> = std::result::Result<T, String>;

/// What an expression is.
#[derive(Clone, Debug)]
pub(crate) enum Value {
    /// The registers of its scalars.
    Scalars(Vec<u32>),
    /// A pointer to a variable: its registers.
    Variable(Vec<u32>, Handle<Type>),
    /// A pointer into a buffer.
    Memory { buffer: usize, base: Option<u32>, offset: u32, ty: Handle<Type> },
    /// A pointer to one scalar of a vector in a buffer.
    Word { buffer: usize, base: Option<u32>, offset: u32 },
}

pub(crate) struct Compiler<'m> {
    pub(crate) module: &'m Module,
    pub(crate) info: &'m ModuleInfo,
    pub(crate) constants: Vec<u64>,
    /// The next register, and the most there have been.
    pub(crate) next: u32,
    pub(crate) most: u32,
    pub(crate) globals: HashMap<Handle<naga::GlobalVariable>, Value>,
}

/// A function where it is written out.
pub(crate) struct Frame<'m> {
    pub(crate) function: &'m Function,
    pub(crate) info: &'m FunctionInfo,
    pub(crate) values: HashMap<Handle<Expression>, Value>,
    pub(crate) locals: HashMap<Handle<LocalVariable>, Value>,
    pub(crate) arguments: Vec<Value>,
    pub(crate) result: Vec<u32>,
}

pub(crate) fn puts(nodes: &mut Vec<Node>, to: &[u32], from: &[u32]) {
    nodes.extend(to.iter().zip(from).map(|(to, from)| Node::Put { to: *to, from: *from }));
}

/// Adds an operation to the last of some nodes.
fn operate(nodes: &mut Vec<Node>, operation: Operation) {
    let counts = u64::from(!matches!(operation.does, Does::Copy | Does::Along(_)));
    if let Some(Node::Operations { list, counted }) = nodes.last_mut() {
        list.push(operation);
        *counted += counts;
    } else {
        nodes.push(Node::Operations { list: vec![operation], counted: counts });
    }
}

impl<'m> Compiler<'m> {
    pub(crate) fn fresh(&mut self, count: usize) -> Vec<u32> {
        let first = self.next;
        self.next += u32::try_from(count).unwrap_or(u32::MAX);
        self.most = self.most.max(self.next);
        (first..self.next).collect()
    }

    pub(crate) fn constant(&mut self, bits: u64) -> Result<u32> {
        let found = self.constants.iter().position(|one| *one == bits).unwrap_or_else(|| {
            self.constants.push(bits);
            self.constants.len() - 1
        });
        u32::try_from(found).ok().filter(|found| *found < CONSTANTS).ok_or("too many constants".to_owned())
    }

    /// How many scalars a type has; of an array of any length one element.
    pub(crate) fn scalars(&self, ty: Handle<Type>) -> Result<usize> {
        Ok(match &self.module.types[ty].inner {
            TypeInner::Scalar(_) | TypeInner::Atomic(_) => 1,
            TypeInner::Vector { size, .. } => *size as usize,
            TypeInner::Array { base, size, .. } => {
                let length = match size {
                    naga::ArraySize::Constant(length) => length.get() as usize,
                    _ => 1,
                };
                length * self.scalars(*base)?
            }
            TypeInner::Struct { members, .. } => {
                let mut sum = 0;
                for member in members {
                    sum += self.scalars(member.ty)?;
                }
                sum
            }
            other => return Err(format!("the type {other:?}")),
        })
    }

    /// The type of a part of a composite, and the scalars before it.
    fn part(&self, ty: Handle<Type>, index: u32) -> Result<(Option<Handle<Type>>, u32)> {
        let count = |ty| Ok::<u32, String>(u32::try_from(self.scalars(ty)?).unwrap_or(u32::MAX));
        match &self.module.types[ty].inner {
            TypeInner::Vector { .. } => Ok((None, index)),
            TypeInner::Array { base, .. } => Ok((Some(*base), index * count(*base)?)),
            TypeInner::Struct { members, .. } => {
                let mut offset = 0;
                for member in &members[..index as usize] {
                    offset += count(member.ty)?;
                }
                Ok((Some(members[index as usize].ty), offset))
            }
            other => Err(format!("a part of {other:?}")),
        }
    }

    /// The kind of a scalar, or of the components of a vector.
    fn kind(inner: &TypeInner) -> Result<Kind> {
        let scalar = inner.scalar().ok_or_else(|| format!("{inner:?} where a number is wanted"))?;
        match (scalar.kind, scalar.width) {
            (ScalarKind::Float, 4) => Ok(Kind::F32),
            (ScalarKind::Float, 8) => Ok(Kind::F64),
            (ScalarKind::Uint, 4) => Ok(Kind::U32),
            (ScalarKind::Bool, _) => Ok(Kind::Bool),
            _ => Err(format!("numbers of the type {scalar:?}")),
        }
    }

    fn kind_of(&self, frame: &Frame<'m>, expression: Handle<Expression>) -> Result<Kind> {
        Self::kind(resolution(frame, expression).inner_with(&self.module.types))
    }

    /// The registers of a constant.
    pub(crate) fn constants_of(
        &mut self,
        arena: &Arena<Expression>,
        expression: Handle<Expression>,
    ) -> Result<Vec<u32>> {
        match &arena[expression] {
            Expression::Literal(literal) => {
                let bits = match literal {
                    Literal::F64(value) => value.to_bits(),
                    Literal::F32(value) => u64::from(value.to_bits()),
                    Literal::U32(value) => u64::from(*value),
                    Literal::Bool(value) => u64::from(*value),
                    other => return Err(format!("the literal {other:?}")),
                };
                Ok(vec![self.constant(bits)?])
            }
            Expression::Constant(constant) => {
                let module = self.module;
                self.constants_of(&module.global_expressions, module.constants[*constant].init)
            }
            Expression::ZeroValue(ty) => {
                let zero = self.constant(0)?;
                Ok(vec![zero; self.scalars(*ty)?])
            }
            Expression::Compose { components, .. } => {
                let mut all = Vec::new();
                for component in components {
                    all.extend(self.constants_of(arena, *component)?);
                }
                Ok(all)
            }
            Expression::Splat { size, value } => {
                let one = self.constants_of(arena, *value)?[0];
                Ok(vec![one; *size as usize])
            }
            other => Err(format!("the constant {other:?}")),
        }
    }

    pub(crate) fn scalar(&mut self, frame: &Frame<'m>, expression: Handle<Expression>) -> Result<u32> {
        Ok(self.registers(frame, expression)?[0])
    }

    pub(crate) fn registers(
        &mut self,
        frame: &Frame<'m>,
        expression: Handle<Expression>,
    ) -> Result<Vec<u32>> {
        match self.value(frame, expression)? {
            Value::Scalars(registers) => Ok(registers),
            _ => Err("a pointer where a value is wanted".to_owned()),
        }
    }

    /// The value of an expression that has been emitted, or needs not be.
    pub(crate) fn value(&mut self, frame: &Frame<'m>, expression: Handle<Expression>) -> Result<Value> {
        if let Some(value) = frame.values.get(&expression) {
            return Ok(value.clone());
        }
        match &frame.function.expressions[expression] {
            Expression::FunctionArgument(index) => Ok(frame.arguments[*index as usize].clone()),
            Expression::LocalVariable(variable) => Ok(frame.locals[variable].clone()),
            Expression::GlobalVariable(variable) => Ok(self.globals[variable].clone()),
            _ => self.constants_of(&frame.function.expressions, expression).map(Value::Scalars),
        }
    }

    /// One operation for every component.
    fn each(&mut self, nodes: &mut Vec<Node>, does: Does, from: [&[u32]; 3]) -> Value {
        let count = from.iter().map(|one| one.len()).max().unwrap_or(0);
        let out = self.fresh(count);
        for (component, out) in out.iter().enumerate() {
            // A scalar beside a vector is that of every component.
            let from = from.map(|one| one.get(component).or(one.first()).copied().unwrap_or(0));
            operate(nodes, Operation { does, out: *out, from });
        }
        Value::Scalars(out)
    }

    pub(crate) fn emitted(
        &mut self,
        frame: &Frame<'m>,
        expression: Handle<Expression>,
        nodes: &mut Vec<Node>,
    ) -> Result<Value> {
        match &frame.function.expressions[expression] {
            Expression::Access { base, index } => {
                let index = self.scalar(frame, *index)?;
                let Value::Memory { buffer, base, offset, ty } = self.value(frame, *base)? else {
                    return Err("an index at run time outside of buffers".to_owned());
                };
                let (inner, stride) = self.part(ty, 1)?;
                let zero = self.constant(0)?;
                let along = self.each(nodes, Does::Along(stride), [&[base.unwrap_or(zero)], &[index], &[]]);
                let Value::Scalars(base) = along else { return Err("no address".to_owned()) };
                let base = Some(base[0]);
                Ok(match inner {
                    Some(ty) => Value::Memory { buffer, base, offset, ty },
                    None => Value::Word { buffer, base, offset },
                })
            }
            Expression::AccessIndex { base, index } => match self.value(frame, *base)? {
                Value::Scalars(registers) => {
                    let (inner, offset) = match resolution(frame, *base) {
                        TypeResolution::Handle(ty) => self.part(*ty, *index)?,
                        TypeResolution::Value(_) => (None, *index),
                    };
                    let count = inner.map_or(Ok(1), |ty| self.scalars(ty))?;
                    Ok(Value::Scalars(registers[offset as usize..][..count].to_vec()))
                }
                Value::Variable(registers, ty) => {
                    let (inner, offset) = self.part(ty, *index)?;
                    let count = inner.map_or(Ok(1), |ty| self.scalars(ty))?;
                    let part = registers[offset as usize..][..count].to_vec();
                    Ok(Value::Variable(part, inner.unwrap_or(ty)))
                }
                Value::Memory { buffer, base, offset, ty } => {
                    let (inner, further) = self.part(ty, *index)?;
                    let offset = offset + further;
                    Ok(match inner {
                        Some(ty) => Value::Memory { buffer, base, offset, ty },
                        None => Value::Word { buffer, base, offset },
                    })
                }
                Value::Word { .. } => Err("a part of a scalar".to_owned()),
            },
            Expression::Splat { size, value } => {
                let one = self.scalar(frame, *value)?;
                Ok(Value::Scalars(vec![one; *size as usize]))
            }
            Expression::Swizzle { size, vector, pattern } => {
                let registers = self.registers(frame, *vector)?;
                Ok(Value::Scalars(
                    pattern[..*size as usize].iter().map(|one| registers[*one as usize]).collect(),
                ))
            }
            Expression::Load { pointer } => match self.value(frame, *pointer)? {
                // A copy: what is stored later is another value.
                Value::Variable(registers, _) => Ok(self.each(nodes, Does::Copy, [&registers, &[], &[]])),
                Value::Memory { buffer, base, offset, ty } => {
                    let to = self.fresh(self.scalars(ty)?);
                    for (to, offset) in to.iter().zip(offset..) {
                        nodes.push(Node::Load { to: *to, buffer, base, offset });
                    }
                    Ok(Value::Scalars(to))
                }
                Value::Word { buffer, base, offset } => {
                    let to = self.fresh(1);
                    nodes.push(Node::Load { to: to[0], buffer, base, offset });
                    Ok(Value::Scalars(to))
                }
                Value::Scalars(_) => Err("a load from no pointer".to_owned()),
            },
            Expression::Compose { components, .. } => {
                let mut all = Vec::new();
                for component in components {
                    all.extend(self.registers(frame, *component)?);
                }
                Ok(Value::Scalars(all))
            }
            _ => self.computed(frame, expression, nodes),
        }
    }

    /// What is computed of numbers.
    fn computed(
        &mut self,
        frame: &Frame<'m>,
        expression: Handle<Expression>,
        nodes: &mut Vec<Node>,
    ) -> Result<Value> {
        match &frame.function.expressions[expression] {
            Expression::Unary { op, expr } => {
                let does = match op {
                    UnaryOperator::Negate => Does::Negate(self.kind_of(frame, *expr)?),
                    UnaryOperator::LogicalNot => Does::Not,
                    UnaryOperator::BitwiseNot => return Err("the operator ~".to_owned()),
                };
                let from = self.registers(frame, *expr)?;
                Ok(self.each(nodes, does, [&from, &[], &[]]))
            }
            Expression::Binary { op, left, right } => {
                let does = Does::Two(*op, self.kind_of(frame, *left)?);
                let (left, right) = (self.registers(frame, *left)?, self.registers(frame, *right)?);
                Ok(self.each(nodes, does, [&left, &right, &[]]))
            }
            Expression::Select { condition, accept, reject } => {
                let condition = self.registers(frame, *condition)?;
                let (accept, reject) = (self.registers(frame, *accept)?, self.registers(frame, *reject)?);
                Ok(self.each(nodes, Does::Select, [&condition, &reject, &accept]))
            }
            Expression::Relational { fun, argument } => {
                let from = self.registers(frame, *argument)?;
                let operator = match fun {
                    RelationalFunction::All => naga::BinaryOperator::LogicalAnd,
                    RelationalFunction::Any => naga::BinaryOperator::LogicalOr,
                    other => return Err(format!("the function {other:?}")),
                };
                let mut all = vec![from[0]];
                for one in &from[1..] {
                    let both = self.each(nodes, Does::Two(operator, Kind::Bool), [&all, &[*one], &[]]);
                    let Value::Scalars(both) = both else { return Err("no scalar".to_owned()) };
                    all = both;
                }
                Ok(Value::Scalars(all))
            }
            Expression::Math { fun, arg, arg1, .. } => {
                let kind = self.kind_of(frame, *arg)?;
                let first = self.registers(frame, *arg)?;
                let second = arg1.map_or(Ok(Vec::new()), |arg| self.registers(frame, arg))?;
                let does = match fun {
                    MathFunction::Abs => Does::Abs(kind),
                    MathFunction::Sqrt => Does::Sqrt(kind),
                    MathFunction::Min => Does::Min(kind),
                    MathFunction::Max => Does::Max(kind),
                    other => return Err(format!("the function {other:?}")),
                };
                Ok(self.each(nodes, does, [&first, &second, &[]]))
            }
            Expression::As { expr, convert, .. } => {
                let from = self.registers(frame, *expr)?;
                if convert.is_none() {
                    return Ok(Value::Scalars(from));
                }
                let does = Does::Convert(self.kind_of(frame, *expr)?, self.kind_of(frame, expression)?);
                Ok(self.each(nodes, does, [&from, &[], &[]]))
            }
            _ => self.constants_of(&frame.function.expressions, expression).map(Value::Scalars),
        }
    }
}

/// What naga says of the type of an expression.
fn resolution<'f>(frame: &Frame<'f>, expression: Handle<Expression>) -> &'f TypeResolution {
    &frame.info[expression].ty
}
