"""How far the frame of the baseline's `listing` is from what its steps approximate: relative RMSE of its radiance
against the same shader with finer steps.

usage: baseline_off.py FOLDER WIDTH_PX HEIGHT_PX"""
import contextlib, io, json, os, runpy, sys
import numpy as np

folder, width, height = sys.argv[1:]
run = os.path.join(folder, "run.py")
sys.argv = [run, "listing", "--frames", "1", "--width-px", width, "--height-px", height]
with contextlib.redirect_stdout(io.StringIO()):
    base = runpy.run_path(run)
ctx, known = base["ctx"], base["prog"]
# The publication's tone curve, taken out: radiance is compared.
linear = {"return pow(c/(1.0+c),vec3(1.0/2.2));": "return c;"}
# Eight times its 128 steps over the same way.
view = {"(maxCloud - minCloud) / 64": "(maxCloud - minCloud) / 512", "i < 128": "i < 1024"}


def light(samples, step):
    return {"i<4;": f"i<{samples};", "float step=avrStep;": f"float step={step};", "if(i==3) step=step*6.0;": ""}


def radiance(changes):
    text = base["read"]("common.glsl") + base["read"]("listingB.frag")
    for old, new in changes.items():
        if text.count(old) != 1:
            sys.exit(f"the shader has not once {old!r}")
        text = text.replace(old, new)
    vertex = "#version 330\nin vec2 p; out vec2 v_uv; void main(){v_uv=p*0.5+0.5; gl_Position=vec4(p,0,1);}"
    program = ctx.program(vertex_shader=vertex, fragment_shader=text)
    for name in program:
        if hasattr(program[name], "value") and name in known:
            program[name].value = known[name].value
    corners = ctx.buffer(np.array([-1, -1, 3, -1, -1, 3], "f4").tobytes())
    frame = ctx.framebuffer([ctx.texture((base["W"], base["H"]), 4, dtype="f4")])
    frame.use()
    ctx.vertex_array(program, [(corners, "2f", "p")]).render()
    return np.frombuffer(frame.read(components=3, dtype="f4"), "f4").astype("f8")


def error(truth):
    return float(np.sqrt(np.sum((seen - truth) ** 2) / np.sum(truth**2)))


seen = radiance(linear)
# Its light samples reach 1.8 units; out of the shell, 20 units thick, it is 31.1 to the sun 50 degrees from the zenith.
print(json.dumps({
    "steps_error": error(radiance(linear | view | light(63, "1.8/63.0"))),
    "light_path_error": error(radiance(linear | view | light(64, "31.1/64.0"))),
}))
