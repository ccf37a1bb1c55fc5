# A cylindrical roller bearing from Julia: read a scene, run it, print where the cage is.
#
#   julia nu2310.jl scenes/nu2310.json
#
# libcagedyn.so is looked for where the system keeps its libraries, or where CAGEDYN_LIBRARY says.

using Printf

const lib = get(ENV, "CAGEDYN_LIBRARY", "libcagedyn")

message() = unsafe_string(@ccall lib.cagedyn_error_message()::Cstring)
check(status) = status == 0 || error(message())
made(handle) = handle == C_NULL ? error(message()) : handle
found(index) = index < 0 ? error(message()) : index

scene = isempty(ARGS) ? "scenes/nu2310.json" : ARGS[1]
model = made(@ccall lib.cagedyn_model_from_file(scene::Cstring)::Ptr{Cvoid})
sim = made(@ccall lib.cagedyn_sim_new(model::Ptr{Cvoid})::Ptr{Cvoid})
place(name) = found(@ccall lib.cagedyn_model_find_output(model::Ptr{Cvoid}, name::Cstring)::Int64)

function output(index)
    value = Ref(0.0)
    check(@ccall lib.cagedyn_sim_get_output(sim::Ptr{Cvoid}, index::Int64, value::Ref{Float64})::Int32)
    value[]
end

y, z = place("cage.y_ratio"), place("cage.z_ratio")
for i in 0:4
    check(@ccall lib.cagedyn_sim_advance_to(sim::Ptr{Cvoid}, (5e-3 * i)::Float64)::Int32)
    @printf("%5.1f ms: cage centre (%.3f, %.3f) of the guide clearance\n", 5.0 * i, output(y), output(z))
end
check(@ccall lib.cagedyn_sim_trust(sim::Ptr{Cvoid})::Int32)
println("the run kept its power balance")
@ccall lib.cagedyn_sim_free(sim::Ptr{Cvoid})::Cvoid
@ccall lib.cagedyn_model_free(model::Ptr{Cvoid})::Cvoid
