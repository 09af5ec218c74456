//! From naga's tree to operations on registers. Functions are written out where they are called.

use std::collections::HashMap;

use naga::valid::ModuleInfo;
use naga::{Block, BuiltIn, Module, Statement};

use crate::code::{CONSTANTS, Code, Node, Place};
use crate::values::{Compiler, Frame, Result, Value, puts};

/// The kernel `main` of a module.
pub(crate) fn compile(module: &Module, info: &ModuleInfo) -> Result<Code> {
    let entry =
        module.entry_points.iter().position(|entry| entry.name == "main").ok_or("there is no main")?;
    let function = &module.entry_points[entry].function;
    let mut compiler = Compiler {
        module,
        info,
        constants: Vec::new(),
        next: CONSTANTS,
        most: CONSTANTS,
        globals: HashMap::new(),
    };
    let mut body = Vec::new();
    for (handle, variable) in module.global_variables.iter() {
        let value = if let Some(binding) = &variable.binding {
            Value::Memory { buffer: binding.binding as usize, base: None, offset: 0, ty: variable.ty }
        } else {
            let registers = compiler.fresh(compiler.scalars(variable.ty)?);
            let zero = compiler.constant(0)?;
            let initial = match variable.init {
                Some(init) => compiler.constants_of(&module.global_expressions, init)?,
                None => vec![zero; registers.len()],
            };
            puts(&mut body, &registers, &initial);
            Value::Variable(registers, variable.ty)
        };
        compiler.globals.insert(handle, value);
    }
    let mut arguments = Vec::new();
    let mut values = Vec::new();
    for argument in &function.arguments {
        let Some(naga::Binding::BuiltIn(what)) = argument.binding else {
            return Err("an argument of main that is no builtin".to_owned());
        };
        let registers = compiler.fresh(compiler.scalars(argument.ty)?);
        for (component, register) in registers.iter().enumerate() {
            arguments.push((place(what, component)?, *register));
        }
        values.push(Value::Scalars(registers));
    }
    let frame = Frame {
        function,
        info: info.get_entry_point(entry),
        values: HashMap::new(),
        locals: HashMap::new(),
        arguments: values,
        result: Vec::new(),
    };
    body.extend(compiler.function(frame)?);
    let Compiler { constants, most, .. } = compiler;
    Ok(Code {
        body,
        constants,
        registers: most,
        arguments,
        workgroup: module.entry_points[entry].workgroup_size[0],
        functions: std::iter::once("main".to_owned()).chain(module.functions.iter().map(name)).collect(),
    })
}

/// The name of a function.
fn name((handle, function): (naga::Handle<naga::Function>, &naga::Function)) -> String {
    function.name.clone().unwrap_or_else(|| format!("function {}", handle.index()))
}

/// What a component of a builtin is.
fn place(what: BuiltIn, component: usize) -> Result<Place> {
    Ok(match (what, component) {
        (BuiltIn::WorkGroupId, 0) => Place::Workgroup,
        (BuiltIn::NumWorkGroups, 0) => Place::Workgroups,
        (BuiltIn::NumWorkGroups, _) => Place::One,
        (BuiltIn::LocalInvocationIndex, _) => Place::Local,
        (BuiltIn::GlobalInvocationId, 0) => Place::Global,
        (BuiltIn::WorkGroupId | BuiltIn::GlobalInvocationId, _) => Place::Zero,
        _ => return Err(format!("the builtin {what:?}")),
    })
}

impl<'m> Compiler<'m> {
    /// A function from its first statement to its last.
    fn function(&mut self, mut frame: Frame<'m>) -> Result<Vec<Node>> {
        let function = frame.function;
        let mut nodes = Vec::new();
        for (handle, variable) in function.local_variables.iter() {
            let registers = self.fresh(self.scalars(variable.ty)?);
            let zero = self.constant(0)?;
            let initial = match variable.init {
                Some(init) => self.constants_of(&function.expressions, init)?,
                None => vec![zero; registers.len()],
            };
            puts(&mut nodes, &registers, &initial);
            frame.locals.insert(handle, Value::Variable(registers, variable.ty));
        }
        self.block(&mut frame, &function.body, &mut nodes)?;
        Ok(nodes)
    }

    /// The statements of a block; its registers are free again behind it.
    fn block(&mut self, frame: &mut Frame<'m>, block: &'m Block, nodes: &mut Vec<Node>) -> Result<()> {
        let before = self.next;
        for statement in block {
            self.statement(frame, statement, nodes)?;
        }
        self.next = before;
        Ok(())
    }

    fn nested(&mut self, frame: &mut Frame<'m>, block: &'m Block) -> Result<Vec<Node>> {
        let mut nodes = Vec::new();
        self.block(frame, block, &mut nodes)?;
        Ok(nodes)
    }

    fn statement(
        &mut self,
        frame: &mut Frame<'m>,
        statement: &'m Statement,
        nodes: &mut Vec<Node>,
    ) -> Result<()> {
        match statement {
            Statement::Emit(range) => {
                for expression in range.clone() {
                    let value = self.emitted(frame, expression, nodes)?;
                    frame.values.insert(expression, value);
                }
            }
            Statement::Block(block) => self.block(frame, block, nodes)?,
            Statement::If { condition, accept, reject } => {
                let condition = self.scalar(frame, *condition)?;
                let (accept, reject) = (self.nested(frame, accept)?, self.nested(frame, reject)?);
                nodes.push(Node::If { condition, accept, reject });
            }
            Statement::Loop { body, continuing, break_if } => {
                // What the condition needs is in the continuing block.
                let before = self.next;
                let mut inner = Vec::new();
                for statement in body {
                    self.statement(frame, statement, &mut inner)?;
                }
                let mut after = Vec::new();
                for statement in continuing {
                    self.statement(frame, statement, &mut after)?;
                }
                let break_if = break_if.map(|condition| self.scalar(frame, condition)).transpose()?;
                self.next = before;
                nodes.push(Node::Loop { body: inner, continuing: after, break_if });
            }
            Statement::Break => nodes.push(Node::Break),
            Statement::Continue => nodes.push(Node::Continue),
            Statement::Return { value } => {
                if let Some(value) = value {
                    let from = self.registers(frame, *value)?;
                    puts(nodes, &frame.result, &from);
                }
                nodes.push(Node::Return);
            }
            Statement::Store { pointer, value } => {
                let from = self.registers(frame, *value)?;
                match self.value(frame, *pointer)? {
                    Value::Variable(to, _) => puts(nodes, &to, &from),
                    Value::Memory { buffer, base, offset, .. } | Value::Word { buffer, base, offset } => {
                        for (from, offset) in from.into_iter().zip(offset..) {
                            nodes.push(Node::Store { from, buffer, base, offset });
                        }
                    }
                    Value::Scalars(_) => return Err("a store to no pointer".to_owned()),
                }
            }
            Statement::Atomic { pointer, fun: naga::AtomicFunction::Add, value, result } => {
                let from = self.scalar(frame, *value)?;
                let Value::Memory { buffer, base, offset, .. } = self.value(frame, *pointer)? else {
                    return Err("an atomic that is in no buffer".to_owned());
                };
                let before = result.map(|result| {
                    let registers = self.fresh(1);
                    frame.values.insert(result, Value::Scalars(registers.clone()));
                    registers[0]
                });
                nodes.push(Node::Add { from, buffer, base, offset, before });
            }
            Statement::Call { function, arguments, result } => {
                let mut values = Vec::new();
                for argument in arguments {
                    values.push(self.value(frame, *argument)?);
                }
                let called = &self.module.functions[*function];
                let returned = match &called.result {
                    Some(result) => self.fresh(self.scalars(result.ty)?),
                    None => Vec::new(),
                };
                let before = self.next;
                let inner = Frame {
                    function: called,
                    info: &self.info[*function],
                    values: HashMap::new(),
                    locals: HashMap::new(),
                    arguments: values,
                    result: returned.clone(),
                };
                let body = self.function(inner)?;
                nodes.push(Node::Call { function: 1 + function.index(), body });
                self.next = before;
                if let Some(result) = result {
                    frame.values.insert(*result, Value::Scalars(returned));
                }
            }
            other => return Err(format!("the statement {other:?}")),
        }
        Ok(())
    }
}
