// Twin: src/engine/kernel/source.rs
// The contract between host and kernels. Words are word-major: word w of instance i at w * count + i.

struct Settings {
    count: u32,
    iterations: u32,
    offset: u32,
    zero: u32,
    zero_real: f32,
    one_real: f32,
    spare: vec2<u32>,
    words: array<vec4<u32>, SETTING_VECTORS>,
}

@group(0) @binding(0) var<uniform> settings: Settings;
@group(0) @binding(1) var<storage, read> inputs: array<real>;
@group(0) @binding(2) var<storage, read_write> state: array<real>;
@group(0) @binding(3) var<storage, read_write> flags: array<u32>;
@group(0) @binding(4) var<storage, read_write> progress: array<atomic<u32>>;

// The instance of an invocation; at or above settings.count there is none.
fn instance_of(workgroup: vec3<u32>, workgroups: vec3<u32>, local: u32) -> u32 {
    return (workgroup.y * workgroups.x + workgroup.x) * WORKGROUP_SIZE + local;
}

fn input(word: u32, instance: u32) -> real {
    return inputs[word * settings.count + instance];
}

fn load(word: u32, instance: u32) -> real {
    return state[word * settings.count + instance];
}

fn store(word: u32, instance: u32, value: real) {
    state[word * settings.count + instance] = value;
}

fn flag(word: u32, instance: u32) -> u32 {
    return flags[word * settings.count + instance];
}

fn set_flag(word: u32, instance: u32, value: u32) {
    flags[word * settings.count + instance] = value;
}

// A kernel-specific word of the settings.
fn setting(word: u32) -> u32 {
    return settings.words[word / 4u][word % 4u];
}

// Ends an instance: its status, and one more in the count of the finished.
fn finish(instance: u32, status: u32) {
    set_flag(FLAG_STATUS, instance, status);
    atomicAdd(&progress[0], 1u);
}

// Whether a number is finite as f32; a comparison with itself is folded away.
fn is_finite(value: real) -> bool {
    return (bitcast<u32>(f32(value)) & 0x7f800000u) != 0x7f800000u;
}
