//! The two-mass belt model: its parameters, its equations, its contact and its eigenvalues; and the eigenvalues of other structures.
//!
//! This file holds the parameters. The table [`PARAMS`] drives the TOML keys, the axes, the CSV columns, the range checks
//! and the axis labels of figures. Units are SI, temperatures in °C.
//!
//! | question | where |
//! |---|---|
//! | one instance: values and friction law | [`instance`], [`friction`], [`material`] |
//! | its sliding equilibrium, and the scaled model around that | [`equilibrium`], [`scaled`] |
//! | equations of motion, contact states, impacts | [`belt`], [`contact`] |
//! | eigenvalues and their attribution, types of instability | [`linear`], [`quartic`], [`kind`] |
//! | modes of any structure instead of two masses | [`modal`], [`spectrum`] |
//! | the fastest mode of each contact state | [`fastest`] |
//! | how an instance ends | [`status`] |

pub mod belt;
pub mod contact;
mod counted;
pub mod equilibrium;
pub mod fastest;
pub mod forms;
pub mod friction;
pub mod heating;
pub mod instance;
pub mod kind;
pub mod linear;
pub mod material;
pub mod modal;
pub mod motion;
mod natural;
pub mod piece;
pub mod quartic;
pub mod scaled;
pub mod spectrum;
pub mod status;
mod table;

/// A numeric parameter of an instance; its row in [`PARAMS`] gives name, unit, default and range.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(usize)]
#[expect(missing_docs, reason = "each variant is documented by its row in PARAMS")]
pub enum Param {
    M1,
    M2,
    K1,
    K2,
    C1,
    C2,
    FExt,
    Theta,
    Restitution,
    DampingRatio,
    DampingRatio1,
    DampingRatio2,
    DampingRatio3,
    DampingRatio4,
    DampingRatio5,
    DampingRatio6,
    DampingRatio7,
    DampingRatio8,
    Kn,
    MuS,
    MuD,
    KneeVelocity,
    StribeckVelocity,
    Decay,
    Temperature,
    TemperatureEnd,
    BeltVelocity,
    BeltVelocityEnd,
    RampDuration,
    RiseDuration,
    StartVelocity,
    StartDisplacement,
    StartFraction,
    StartEventFraction,
    LargeVelocity,
    LargeDisplacement,
    BoxDisplacementFrom,
    BoxDisplacementTo,
    BoxVelocityFrom,
    BoxVelocityTo,
}

/// The sweep-file section a parameter belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the variants are the section names")]
pub enum Section {
    Model,
    Friction,
    Belt,
    Start,
}

impl Section {
    /// The TOML table name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Section::Model => "model",
            Section::Friction => "friction",
            Section::Belt => "belt",
            Section::Start => "start",
        }
    }
}

/// The closed or open interval of legal values, with both ends.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "the variants are inequalities")]
pub enum Range {
    Positive,
    NonNegative,
    Finite,
    /// Strictly between the two bounds.
    Open(f64, f64),
    /// Between the two bounds, ends included.
    Closed(f64, f64),
}

impl Range {
    /// Whether `value` is finite and inside the interval.
    #[must_use]
    pub fn contains(self, value: f64) -> bool {
        value.is_finite()
            && match self {
                Range::Positive => value > 0.0,
                Range::NonNegative => value >= 0.0,
                Range::Finite => true,
                Range::Open(low, high) => low < value && value < high,
                Range::Closed(low, high) => (low..=high).contains(&value),
            }
    }
}

impl std::fmt::Display for Range {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        // Powers of ten that are no sizes of anything need few digits.
        let shown = |value: &f64| if value.abs() < 1e7 { format!("{value}") } else { format!("{value:e}") };
        match self {
            Range::Positive => write!(f, "a finite number greater than 0"),
            Range::NonNegative => write!(f, "a finite number not below 0"),
            Range::Finite => write!(f, "a finite number"),
            Range::Open(low, high) => write!(f, "strictly between {} and {}", shown(low), shown(high)),
            Range::Closed(low, high) => write!(f, "between {} and {}", shown(low), shown(high)),
        }
    }
}

/// One row of the parameter table.
#[derive(Clone, Copy, Debug)]
pub struct ParamInfo {
    /// The parameter itself; row `i` describes the parameter with discriminant `i`.
    pub param: Param,
    /// The flat name, the same in TOML, axes and CSV.
    pub name: &'static str,
    /// The symbol as figures print it; `_` begins a subscript, e.g. `μ_s`.
    pub symbol: &'static str,
    /// The SI unit; empty when dimensionless.
    pub unit: &'static str,
    /// Where it stands in a sweep file.
    pub section: Section,
    /// The value of an omitted key. With `None` the key has to be given wherever it is used.
    pub default: Option<f64>,
    /// Legal values.
    pub range: Range,
    /// One line of explanation.
    pub meaning: &'static str,
}

macro_rules! params {
    ($($param:ident $name:literal $symbol:literal $unit:literal $section:ident $default:expr, $range:expr, $meaning:literal;)*) => {
        /// Every numeric parameter, in the order of [`Param`]'s variants. Defaults: Table 1 of the paper.
        pub const PARAMS: &[ParamInfo] = &[$(ParamInfo {
            param: Param::$param, name: $name, symbol: $symbol, unit: $unit, section: Section::$section,
            default: $default, range: $range, meaning: $meaning,
        }),*];
    };
}

params! {
    M1 "m1" "m_1" "kg" Model Some(2.12), Range::Positive, "mass above the normal spring";
    M2 "m2" "m_2" "kg" Model Some(0.18), Range::Positive, "mass in contact with the belt";
    K1 "k1" "k_1" "N/m" Model Some(100_000.0), Range::Positive, "tangential stiffness";
    K2 "k2" "k_2" "N/m" Model Some(101_000.0), Range::Positive, "normal stiffness";
    C1 "c1" "c_1" "N s/m" Model Some(0.1), Range::NonNegative, "tangential damping";
    C2 "c2" "c_2" "N s/m" Model Some(0.1), Range::NonNegative, "normal damping";
    FExt "f_ext" "F_ext" "N" Model Some(1000.0), Range::Positive, "external normal force";
    Theta "theta" "θ" "rad" Model Some(0.01), Range::Open(-std::f64::consts::FRAC_PI_2, std::f64::consts::FRAC_PI_2), "inclination of the contact";
    Restitution "restitution" "e" "" Model Some(0.0), Range::Closed(0.0, 1.0), "Newton restitution of the impact after a detachment";
    DampingRatio "damping_ratio" "ζ" "" Model None, Range::Closed(0.0, 1.0), "damping ratio added to every mode without friction; none where it is left out";
    DampingRatio1 "damping_ratio_1" "ζ_1" "" Model None, Range::Closed(0.0, 1.0), "damping ratio of mode 1, in addition to that of all";
    DampingRatio2 "damping_ratio_2" "ζ_2" "" Model None, Range::Closed(0.0, 1.0), "damping ratio of mode 2, in addition to that of all";
    DampingRatio3 "damping_ratio_3" "ζ_3" "" Model None, Range::Closed(0.0, 1.0), "damping ratio of mode 3, in addition to that of all";
    DampingRatio4 "damping_ratio_4" "ζ_4" "" Model None, Range::Closed(0.0, 1.0), "damping ratio of mode 4, in addition to that of all";
    DampingRatio5 "damping_ratio_5" "ζ_5" "" Model None, Range::Closed(0.0, 1.0), "damping ratio of mode 5, in addition to that of all";
    DampingRatio6 "damping_ratio_6" "ζ_6" "" Model None, Range::Closed(0.0, 1.0), "damping ratio of mode 6, in addition to that of all";
    DampingRatio7 "damping_ratio_7" "ζ_7" "" Model None, Range::Closed(0.0, 1.0), "damping ratio of mode 7, in addition to that of all";
    DampingRatio8 "damping_ratio_8" "ζ_8" "" Model None, Range::Closed(0.0, 1.0), "damping ratio of mode 8, in addition to that of all";
    Kn "kn" "k_n" "Pa/m" Model None, Range::Positive, "contact stiffness (of a modal model); that of its file where it is left out";
    MuS "mu_s" "μ_s" "" Friction None, Range::NonNegative, "static friction coefficient";
    MuD "mu_d" "μ_d" "" Friction None, Range::NonNegative, "dynamic friction coefficient";
    KneeVelocity "knee_velocity" "v_k" "m/s" Friction Some(5.0), Range::Positive, "relative velocity from which the bilinear law is constant";
    StribeckVelocity "stribeck_velocity" "v_0" "m/s" Friction None, Range::Positive, "decay velocity of the exponential law";
    Decay "decay" "δ" "s/m" Friction None, Range::NonNegative, "decay constant of the rational law";
    Temperature "temperature" "ϑ" "°C" Friction None, Range::Finite, "temperature at which a material is read";
    TemperatureEnd "temperature_end" "ϑ_end" "°C" Friction None, Range::Finite, "temperature of the material after `ramp_duration`, straight from `temperature`";
    BeltVelocity "belt_velocity" "V" "m/s" Belt None, Range::NonNegative, "belt velocity (at the start of a ramp, the largest of a sine or trapeze)";
    BeltVelocityEnd "belt_velocity_end" "V_end" "m/s" Belt None, Range::NonNegative, "belt velocity at the end of a ramp";
    RampDuration "ramp_duration" "t_ramp" "s" Belt None, Range::Positive, "duration of the ramp, or of another motion of the belt";
    RiseDuration "rise_duration" "t_rise" "s" Belt None, Range::Positive, "time in which the belt of a trapeze comes to its velocity, and to rest again; at most half of all";
    StartVelocity "start_velocity" "ẋ_2,0" "m/s" Start Some(0.01), Range::Finite, "kick: velocity added to x2' at the sliding equilibrium";
    StartDisplacement "start_displacement" "x_2,0" "m" Start Some(0.0), Range::Finite, "kick: displacement added to x2 at the sliding equilibrium";
    StartFraction "start_fraction" "a_0" "" Start Some(0.01), Range::Positive, "mode start: amplitude of x2' as a fraction of the belt velocity";
    StartEventFraction "start_event_fraction" "a_e" "" Start None, Range::Open(0.0, 1.0), "mode start: amplitude as a fraction of that at which the mode first meets an event";
    LargeVelocity "large_velocity" "ẋ_2,L" "m/s" Start None, Range::Finite, "large start: velocity added to x2' at the sliding equilibrium; by default that of the belt, which is stick";
    LargeDisplacement "large_displacement" "x_2,L" "m" Start Some(0.0), Range::Finite, "large start: displacement added to x2 at the sliding equilibrium";
    BoxDisplacementFrom "box_displacement_from" "x_2,a" "m" Start None, Range::Closed(-1e150, 1e150), "box of starts: one bound of the displacement added to x2 at the sliding equilibrium";
    BoxDisplacementTo "box_displacement_to" "x_2,b" "m" Start None, Range::Closed(-1e150, 1e150), "box of starts: the other bound of that displacement";
    BoxVelocityFrom "box_velocity_from" "ẋ_2,a" "m/s" Start None, Range::Closed(-1e150, 1e150), "box of starts: one bound of the velocity added to x2' at the sliding equilibrium";
    BoxVelocityTo "box_velocity_to" "ẋ_2,b" "m/s" Start None, Range::Closed(-1e150, 1e150), "box of starts: the other bound of that velocity";
}

impl Param {
    /// The number of parameters.
    pub const COUNT: usize = PARAMS.len();

    /// Temperatures of a material: at the start of a run, and at the end of its course.
    pub const TEMPERATURES: [Param; 2] = [Param::Temperature, Param::TemperatureEnd];

    /// The damping ratios of single modes of a structure, from the lowest on.
    pub const DAMPING_RATIOS: [Param; modal::EACH] = [
        Param::DampingRatio1,
        Param::DampingRatio2,
        Param::DampingRatio3,
        Param::DampingRatio4,
        Param::DampingRatio5,
        Param::DampingRatio6,
        Param::DampingRatio7,
        Param::DampingRatio8,
    ];

    /// The parameter's row in [`PARAMS`].
    #[must_use]
    pub fn info(self) -> &'static ParamInfo {
        &PARAMS[self as usize]
    }

    /// The parameter with this flat name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Param> {
        PARAMS.iter().find(|row| row.name == name).map(|row| row.param)
    }
}

/// A value (or nothing) for every numeric parameter.
#[derive(Clone, Copy, Debug)]
pub struct Params([f64; Param::COUNT]);

/// The bits of what stands for nothing, a number that no computation makes: an option takes twice the room, and an instance is
/// copied on its way.
const NOTHING: u64 = 0x7ff8_6e6f_7468_696e;

impl PartialEq for Params {
    fn eq(&self, other: &Params) -> bool {
        PARAMS.iter().all(|row| self.get(row.param) == other.get(row.param))
    }
}

impl Default for Params {
    /// Table 1 of the paper where it gives a value, nothing elsewhere.
    fn default() -> Self {
        Params(std::array::from_fn(|i| PARAMS[i].default.unwrap_or(f64::from_bits(NOTHING))))
    }
}

impl Params {
    /// The value of `param`, if it has one.
    #[must_use]
    pub fn get(&self, param: Param) -> Option<f64> {
        let value = self.0[param as usize];
        (value.to_bits() != NOTHING).then_some(value)
    }

    /// Sets the value of `param`.
    pub fn set(&mut self, param: Param, value: f64) {
        self.0[param as usize] = value;
    }

    /// The value of a parameter that validation has made sure of.
    ///
    /// # Panics
    /// When the parameter has no value: a defect of the validation, not of the input.
    #[must_use]
    pub fn require(&self, param: Param) -> f64 {
        self.get(param).unwrap_or_else(|| panic!("{} was validated to be present", param.info().name))
    }
}
