// Entry point of the linear kernel: one invocation, one instance, finished in one dispatch.

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(num_workgroups) workgroups: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    let instance = instance_of(workgroup, workgroups, local);
    if instance >= settings.count || flag(FLAG_STATUS, instance) != STATUS_UNWRITTEN {
        return;
    }
    analyse(instance);
}
