// Twin: src/engine/kernel/source.rs
// The contract between host and kernels. The words of TOGETHER instances lie together, word by word.

struct Settings {
    count: u32,
    iterations: u32,
    offset: u32,
    zero: u32,
    zero_real: f32,
    one_real: f32,
    state_words: u32,
    spare: u32,
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

// The place of the first word of an instance that has so many. The next one is TOGETHER further, a constant.
fn first_place(words: u32, instance: u32) -> u32 {
    return (instance / TOGETHER) * (words * TOGETHER) + instance % TOGETHER;
}

fn input(word: u32, instance: u32) -> real {
    return inputs[first_place(INPUT_WORDS, instance) + word * TOGETHER];
}

fn load(word: u32, instance: u32) -> real {
    return state[first_place(settings.state_words, instance) + word * TOGETHER];
}

fn store(word: u32, instance: u32, value: real) {
    state[first_place(settings.state_words, instance) + word * TOGETHER] = value;
}

fn flag(word: u32, instance: u32) -> u32 {
    return flags[first_place(FLAG_WORDS, instance) + word * TOGETHER];
}

fn set_flag(word: u32, instance: u32, value: u32) {
    flags[first_place(FLAG_WORDS, instance) + word * TOGETHER] = value;
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
