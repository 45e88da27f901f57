# SPDX-License-Identifier: MIT
"""An add-on for Blender: bends the active mesh object with sliders, its wrinkles too, and bakes that to shape keys.

The deformation is libgoffer's (modules/c/include/goffer.h), called by ctypes and NumPy. The rest shape is the mesh's
own Basis, which bending never writes; what is bent lies in a shape key, so that Blender saves, undoes and copies it.
All is in one file, since that is what Blender installs.
"""

import collections
import ctypes as c
import ctypes.util
import hashlib
import math
import os
import sys
import textwrap

import bmesh
import bpy
import numpy as np

bl_info = {
    "name": "goffer bend",
    "author": "goffer",
    "version": (0, 1, 0),
    "blender": (2, 93, 0),
    "location": "3D View > Sidebar > goffer",
    "description": "Bend soft, longish meshes; the squeezed side wrinkles",
    "category": "Mesh",
}

VERSION = "0.1."  # of the library; another minor version may have other structs
MAX_REGIONS = 32
LIVE_KEY, BAKED_KEY, FRAME_KEY = "goffer bend", "goffer baked ", "goffer frame "
BENT = "goffer_bent"  # the custom property that plays baked keys: 0 at rest, 1 bent
PROFILES, AMPLITUDES = ("EVEN", "DAMPED", "SMOOTH"), ("NONE", "PAPER", "AREA", "MESH")
AXES = {"X": (1, 0, 0), "Y": (0, 1, 0), "Z": (0, 0, 1), "-X": (-1, 0, 0), "-Y": (0, -1, 0), "-Z": (0, 0, -1)}


class Fault(Exception):
    """What went wrong, in words for whoever sits before the panel."""


# ---- The library ----


class Error(c.Structure):
    _fields_ = [("text", c.c_char * 512), ("code", c.c_int)]


class Mesh(c.Structure):
    _fields_ = [("positions", c.c_void_p), ("normals", c.c_void_p), ("tangents", c.c_void_p),
                ("vertex_count", c.c_size_t), ("triangles", c.c_void_p), ("triangle_count", c.c_size_t),
                ("wrinkle_mask", c.c_void_p)]


class BindOptions(c.Structure):
    _fields_ = [("profile", c.c_int), ("amplitude", c.c_int), ("roundness", c.c_double), ("folds", c.c_int),
                ("fold_length", c.c_double), ("one_radius", c.c_int), ("straight", c.c_int), ("onset", c.c_double),
                ("wrinkle_first", c.c_double), ("wrinkle_last", c.c_double), ("axis", c.POINTER(c.c_double)),
                ("shares", c.POINTER(c.c_double)), ("region_count", c.c_size_t), ("folds_apart", c.c_int),
                ("arcs", c.c_int)]


class Pose(c.Structure):
    _fields_ = [("angle", c.c_float), ("direction", c.c_float)]


class Base(c.Structure):
    _fields_ = [("origin", c.c_double * 3), ("axis", c.c_double * 3), ("zero", c.c_double * 3),
                ("length", c.c_double), ("radius", c.c_double), ("rest_angle", c.c_double),
                ("rest_direction", c.c_double), ("residual", c.c_double)]


class Folds(c.Structure):
    _fields_ = [("made", c.c_int), ("capacity", c.c_int), ("suitable", c.c_int), ("shortage", c.c_int)]
    ROWS, RANGE, LENGTH = 1, 2, 3  # what made there be too few


class Stream(c.Structure):
    _fields_ = [("component", c.c_void_p * 4), ("stride", c.c_size_t), ("count", c.c_size_t)]


class PackedStream(c.Structure):
    _fields_ = [("first", c.c_void_p), ("stride", c.c_size_t), ("count", c.c_size_t)]


class Job(c.Structure):
    _fields_ = [("body", c.c_void_p), ("poses", c.c_void_p), ("pose_count", c.c_size_t),
                ("wrinkle_weight", c.c_float), ("transform", c.c_void_p), ("positions", Stream),
                ("normals", Stream), ("tangents", Stream), ("packed", PackedStream), ("previous_positions", Stream),
                ("previous_poses", c.c_void_p), ("previous_transform", c.c_void_p), ("bounds", c.c_void_p),
                ("isa", c.c_int)]


class JobResult(c.Structure):
    _fields_ = [("clamped", c.c_int), ("at_rest", c.c_int)]


FUNCTIONS = {
    "goffer_bind_defaults": (BindOptions,),
    "goffer_body_bind": (c.c_void_p, c.POINTER(Mesh), c.POINTER(BindOptions), c.POINTER(Error)),
    "goffer_body_free": (None, c.c_void_p),
    "goffer_body_region_count": (c.c_size_t, c.c_void_p),
    "goffer_body_max_angle": (c.c_float, c.c_void_p, c.c_size_t),
    "goffer_body_rest_pose": (Pose, c.c_void_p, c.c_size_t),
    "goffer_body_order": (c.POINTER(c.c_uint32), c.c_void_p),
    "goffer_body_base": (Base, c.c_void_p),
    "goffer_body_folds": (Folds, c.c_void_p, c.c_size_t),
    "goffer_job_defaults": (Job,),
    "goffer_job_validate": (c.c_int, c.POINTER(Job), c.POINTER(Error)),
    "goffer_job_run_parallel": (JobResult, c.POINTER(Job)),
}


def opened(path):
    """The library of that path, with its functions declared; a Fault where it is none that can be used."""
    try:
        library = c.CDLL(path)
    except OSError as error:
        raise Fault(f"The library cannot be loaded: {error}") from error
    try:
        library.goffer_version.restype = c.c_char_p
        version = library.goffer_version().decode()
        if not version.startswith(VERSION):
            raise Fault(f"{path} is goffer {version}, and this add-on needs {VERSION}x: install the two that "
                        "come together")
        for name, (result, *arguments) in FUNCTIONS.items():
            function = getattr(library, name)
            function.restype, function.argtypes = result, arguments
    except AttributeError as error:
        raise Fault(f"{path} is no libgoffer that this add-on can use: {error}") from error
    return library


def preferred_path():
    addon = bpy.context.preferences.addons.get(__name__)
    return bpy.path.abspath(addon.preferences.library) if addon is not None else ""


def found_path():
    """A library beside this file, or where the system keeps its own."""
    name = {"win32": "goffer.dll", "darwin": "libgoffer.dylib"}.get(sys.platform, "libgoffer.so")
    beside = os.path.join(os.path.dirname(os.path.abspath(__file__)), name)
    found = beside if os.path.exists(beside) else ctypes.util.find_library("goffer")
    if not found:
        raise Fault(f"{name} is not found. Give its path in Edit > Preferences > Add-ons > goffer bend")
    return found


class Body:
    """A mesh that was bound, and its memory in the library."""

    def __init__(self, library, positions, triangles, mask, options):
        self.library, self.count, error = library, len(positions), Error()
        mesh = Mesh(positions.ctypes.data, None, None, len(positions), triangles.ctypes.data, len(triangles),
                    None if mask is None else mask.ctypes.data)
        self.handle = library.goffer_body_bind(c.byref(mesh), c.byref(options), c.byref(error))
        if not self.handle:
            raise Fault("This mesh cannot be bent: " + error.text.decode())
        self.regions = range(library.goffer_body_region_count(self.handle))
        self.base = library.goffer_body_base(self.handle)
        self.folds = [library.goffer_body_folds(self.handle, r) for r in self.regions]
        self.limits = [library.goffer_body_max_angle(self.handle, r) for r in self.regions]
        self.rest = [library.goffer_body_rest_pose(self.handle, r) for r in self.regions]
        order = library.goffer_body_order(self.handle)
        self.order = np.ctypeslib.as_array(order, (self.count,)) if order else slice(None)

    def free(self):
        self.library.goffer_body_free(self.handle)
        self.handle = None

    def bend(self, poses, weight):
        """Positions in the order of the mesh. `poses`: an (angle, direction) for each region, radians."""
        poses = np.ascontiguousarray(poses, np.float32)
        bent, error = np.empty((self.count, 3), np.float32), Error()
        first = bent.ctypes.data
        job = self.library.goffer_job_defaults()
        job.body, job.poses, job.pose_count = self.handle, poses.ctypes.data, len(poses)
        job.wrinkle_weight = weight
        job.positions = Stream((c.c_void_p * 4)(first, first + 4, first + 8, None), 12, self.count)
        if not self.library.goffer_job_validate(c.byref(job), c.byref(error)):
            raise Fault("It cannot be bent: " + error.text.decode())
        self.library.goffer_job_run_parallel(c.byref(job))
        result = np.empty_like(bent)
        result[self.order] = bent
        return result


class Store:
    """The library, the body of each object that is bent, and the KEPT others of last use. They are known by their
    contents, so that undo, a reload and other objects find the right one or none."""

    KEPT = 8

    def __init__(self):
        self.path, self.found, self.bodies = None, None, collections.OrderedDict()
        self.of_object = {}  # by its name, what its body is known by

    def library(self):
        path = preferred_path()
        if path != self.path:
            self.clear()
            self.path = path  # what was found is kept, a fault too: looking takes too long for every draw
            try:
                self.found = opened(path or found_path())
            except Fault as fault:
                self.found = fault
        if isinstance(self.found, Fault):
            raise self.found
        return self.found

    def body(self, positions, triangles, mask, settings, user=None):
        """`user` names the object that the body is of."""
        library = self.library()
        options, words = bind_options(library, settings)
        if len(positions) == 0 or len(triangles) == 0:
            raise Fault("This mesh has no faces: there is nothing to bend")
        name = hashlib.blake2b(positions.tobytes() + triangles.tobytes() +
                               (b"" if mask is None else mask.tobytes()) + repr(words).encode()).digest()
        known = name in self.bodies
        if not known:
            self.bodies[name] = Body(library, positions, triangles, mask, options)
        self.bodies.move_to_end(name)
        if user is not None:
            self.of_object[user] = name
        if not known:
            self.trim()
        return self.bodies[name]

    def trim(self):
        """Frees those that no object is bent by, but for the KEPT last."""
        objects = ((user, bpy.data.objects.get(user)) for user in list(self.of_object))
        self.of_object = {user: self.of_object[user] for user, obj in objects
                          if obj is not None and obj.goffer_bend.active}
        used = set(self.of_object.values())
        for name in [name for name in self.bodies if name not in used][:-self.KEPT]:
            self.bodies.pop(name).free()

    def clear(self):
        for body in self.bodies.values():
            body.free()
        self.bodies.clear()
        self.of_object.clear()
        self.path = self.found = None


store = Store()


def shares_of(settings):
    """What each region is of the length; empty: there is one."""
    words = settings.regions.replace(",", " ").split()
    try:
        shares = [float(word) for word in words]
    except ValueError:
        shares = [math.nan]
    if shares and not (abs(sum(shares) - 1) < 1e-6 and min(shares) > 0 and len(shares) <= MAX_REGIONS):
        raise Fault(f"Regions: '{settings.regions}' is no list of shares that add up to 1, as 0.3, 0.4, 0.3")
    return shares


def bind_options(library, settings):
    """The options, and the numbers in them that tell them from others."""
    options, shares = library.goffer_bind_defaults(), shares_of(settings)
    options.profile, options.amplitude = PROFILES.index(settings.profile), AMPLITUDES.index(settings.amplitude)
    # Decimals as they were typed: properties are floats, and the library takes doubles.
    typed = {name: float(f"{getattr(settings, name):.7g}")
             for name in ("roundness", "fold_length", "wrinkle_first", "wrinkle_last", "onset")}
    for name, value in typed.items():
        setattr(options, name, value)
    options.folds = settings.folds
    options.one_radius, options.straight = settings.one_radius, settings.straight
    axis = None if settings.axis == "AUTO" else AXES.get(settings.axis, tuple(settings.axis_vector))
    if axis is not None:
        options.axis = (c.c_double * 3)(*axis)
    if shares:
        options.shares, options.region_count = (c.c_double * len(shares))(*shares), len(shares)
    words = (settings.profile, settings.amplitude, settings.folds, settings.one_radius, settings.straight, axis,
             shares, typed)
    return options, words


# ---- What Blender has ----


def check_object(obj):
    if obj is None or obj.type != "MESH":
        raise Fault("Select a mesh object")
    if obj.library is not None or obj.data.library is not None or obj.override_library is not None:
        raise Fault("This object is linked from another file: make it local first")
    if obj.mode in {"EDIT", "SCULPT"}:
        raise Fault("Go to Object Mode first (Tab)")
    if obj.data.users - obj.data.use_fake_user > 1:
        raise Fault("Several objects share this mesh: Object > Relations > Make Single User > Object & Data")
    keys = obj.data.shape_keys
    if keys is not None and not keys.use_relative:
        raise Fault("The shape keys of this mesh are absolute: only relative ones go with bending")
    if not whole_scale(obj).astype(np.float32).all():
        raise Fault("The scale of this object, or its delta scale, is 0 along an axis")


def whole_scale(obj):
    return np.array(obj.scale, np.float64) * np.array(obj.delta_scale, np.float64)


def scale_of(obj):
    """What positions are multiplied by, so that the body is bent as it looks. 1 where the scale is even."""
    scale = whole_scale(obj)
    even = np.ptp(np.abs(scale)) <= 1e-6 * np.abs(scale).max()
    return np.ones(3, np.float32) if even else scale.astype(np.float32)


def coordinates(elements):
    result = np.empty((len(elements), 3), np.float32)
    elements.foreach_get("co", result.ravel())
    return result


def rest_of(mesh):
    return coordinates(mesh.shape_keys.key_blocks[0].data if mesh.shape_keys else mesh.vertices)


def mask_of(obj, mesh):
    """How much each vertex of `mesh` wrinkles: its weight in the object's group that was chosen. None: fully."""
    name = obj.goffer_bend.mask
    if not name:
        return None
    group = obj.vertex_groups.get(name)
    if group is None:
        raise Fault(f"This object has no vertex group '{name}': choose another under Folds, or none")
    mask, wanted = np.zeros(len(mesh.vertices), np.float32), group.index
    for i, vertex in enumerate(mesh.vertices):  # foreach_get has no weights, and nothing says that they have changed
        for element in vertex.groups:
            if element.group == wanted:
                mask[i] = element.weight
                break
    return mask


def body_of(obj, trial=None):
    """The body of the object's rest shape, or of a `trial` mesh in its place, and the scale that it was bound in."""
    check_object(obj)
    mesh, scale = trial or obj.data, scale_of(obj)
    positions = rest_of(mesh)
    mesh.calc_loop_triangles()
    triangles = np.empty((len(mesh.loop_triangles), 3), np.int32)
    mesh.loop_triangles.foreach_get("vertices", triangles.ravel())
    return store.body(positions * scale, triangles.astype(np.uint32), mask_of(obj, mesh), obj.goffer_bend,
                      None if trial else obj.name), scale


def poses_of(settings, body):
    return [(settings.angles[r], settings.directions[r]) for r in body.regions]


def add_key(obj, name, positions):
    settings = obj.goffer_bend
    if obj.data.shape_keys is None:
        obj.shape_key_add(name="Basis", from_mix=False)
        settings.made_basis = True
    key = obj.shape_key_add(name=name, from_mix=False)
    key.data.foreach_set("co", positions.ravel())
    return key


def strips_of(strips):
    """All strips of the NLA, those within others too."""
    for strip in strips:
        yield strip
        yield from strips_of(strip.strips)


def actions_of(animation):
    """An action for each time that it is played."""
    strips = strips_of(strip for track in animation.nla_tracks for strip in track.strips)
    return [action for action in (animation.action, *(strip.action for strip in strips)) if action is not None]


def is_shared(action, animation):
    """Whether others than whose `animation` it is play it too."""
    return action.users - action.use_fake_user > actions_of(animation).count(action)


def remove_curves(animation, is_wanted):
    """Removes the curves whose path is_wanted(), of the action and of those in the NLA. Returns the names of actions
    that others play too, which keep them."""
    shared = set()
    for action in dict.fromkeys(actions_of(animation) if animation is not None else []):
        curves = [curve for curve in action.fcurves if is_wanted(curve.data_path)]
        if curves and is_shared(action, animation):
            shared.add(action.name)
            continue
        for curve in curves:
            action.fcurves.remove(curve)
        if curves and not action.fcurves and action == animation.action:
            animation.action = None
    return shared


def own_action(animated):
    """An action that others play too is copied, so that they do not get the keyframes that are to come."""
    animation = animated.animation_data
    if animation is not None and animation.action is not None and is_shared(animation.action, animation):
        animation.action = animation.action.copy()


def remove_keys(obj, prefixes):
    """Removes the keys of these names, with what animates them; the Basis too where it was made here and is alone.
    Returns what remove_curves() does."""
    keys = obj.data.shape_keys
    removed = [key for key in (keys.key_blocks[1:] if keys else []) if key.name.startswith(prefixes)]
    paths = {key.path_from_id("value") for key in removed}
    shared = remove_curves(keys.animation_data, paths.__contains__) if keys else set()
    for key in removed:
        key.driver_remove("value")
        obj.shape_key_remove(key)
    if keys is not None and len(keys.key_blocks) == 1 and obj.goffer_bend.made_basis:
        obj.shape_key_clear()
        obj.goffer_bend.made_basis = False
    obj.data.update()
    return shared


def remove_property(obj):
    """Returns what remove_curves() does."""
    if BENT in obj:
        del obj[BENT]
    return remove_curves(obj.animation_data, f'["{BENT}"]'.__eq__)


def remove_sliders(obj):
    """Removes what animates the sliders. Returns what remove_curves() does."""
    animation, prefix = obj.animation_data, "goffer_bend."
    for driver in [driver for driver in (animation.drivers if animation else []) if
                   driver.data_path.startswith(prefix)]:
        animation.drivers.remove(driver)
    return remove_curves(animation, lambda path: path.startswith(prefix))


def remove_baked(obj, *more):
    """Removes baked keys, those named `more` and the property, with what animates them. Returns what remove_curves()
    does."""
    return remove_keys(obj, (BAKED_KEY, FRAME_KEY, *more)) | remove_property(obj)


def degrees(radians):
    return f"{math.degrees(radians):.4g}\u00b0"


def describe(obj, body, poses):
    """Facts and warnings for the panel, a line each."""
    settings, base = obj.goffer_bend, body.base
    largest = ", ".join(degrees(limit) for limit in body.limits)
    made = ", ".join(str(folds.made) for folds in body.folds)
    facts = [f"Length {base.length:.4g}", f"Radius {base.radius:.4g}", f"Largest angle {largest}", f"Folds {made}"]
    if base.rest_angle:
        facts.append(f"At rest bent by {degrees(base.rest_angle)} toward {degrees(base.rest_direction)}")
    warnings, mended = [], False
    if any(abs(angle) > limit for (angle, _), limit in zip(poses, body.limits)):
        warnings.append("The angle is beyond the largest; the largest is used")
    for r in body.regions:
        text, by_rows = too_few(body.folds[r], settings)
        if text:
            warnings.append(f"Region {r + 1}: {text}" if len(body.regions) > 1 else text)
        mended = mended or by_rows
    if base.residual > 0.6:
        warnings.append("The body is not a cylinder, and may look odd when bent: try another axis")
    if (scale_of(obj) != 1).any():
        warnings.append("The object's scale is uneven: it is bent as it looks. Apply the scale to be rid of this")
    settings.facts, settings.warnings, settings.needs_rows = "\n".join(facts), "\n".join(warnings), mended


def is_ranged(settings):
    return settings.wrinkle_first > 0 or settings.wrinkle_last < 1


def too_few(folds, settings):
    """What to say of a region with too few folds, and whether more rows may mend it."""
    if folds.shortage == Folds.RANGE:
        return ("0 folds: what From and To leave is too short for them to fade in, or its rows are too far apart. "
                "Take more of the length, or Add Rows", True)
    if folds.shortage == Folds.LENGTH:
        return "0 folds: in so long a body they would be longer than 2.5 radii. Give it Regions, under Body", False
    if folds.shortage == Folds.ROWS:
        wanted = settings.folds if settings.folds > 0 else folds.suitable
        return (f"{folds.made} folds; {wanted} need a finer mesh, this one has vertices for {folds.capacity}. "
                "Add Rows, or Blender's Subdivide", True)
    return "", False


def lacks_folds(folds, settings):
    """Whether more rows might make more folds, few enough to warn of or not."""
    if settings.amplitude == "NONE" or settings.folds == 0 or folds.suitable == 0:
        return False
    if settings.folds > 0:
        return folds.capacity < settings.folds
    return folds.made == 0 if is_ranged(settings) else folds.made < folds.suitable


def show(obj, evaluated=None):
    """Bends the object's live key as the settings say; as those of `evaluated` where an animation says more."""
    body, scale = body_of(obj)
    settings = obj.goffer_bend
    poses = poses_of((evaluated or obj).goffer_bend, body)
    positions = body.bend(poses, (evaluated or obj).goffer_bend.wrinkles) / scale
    keys = obj.data.shape_keys
    key = keys.key_blocks.get(LIVE_KEY) if keys is not None else None
    if key is None:
        key = add_key(obj, LIVE_KEY, positions)
    key.data.foreach_set("co", positions.ravel())
    key.value = 1
    obj.data.update()
    describe(obj, body, poses)


def follow(settings, _context):
    """A slider was moved."""
    if not settings.active:
        return
    try:
        show(settings.id_data)
        settings.fault = ""
    except Fault as fault:
        settings.fault = str(fault)


@bpy.app.handlers.persistent
def follow_frame(scene, depsgraph=None):
    """Keyframed angles bend the object in every frame."""
    for obj in scene.objects:
        if obj.type != "MESH" or not obj.goffer_bend.active or obj.animation_data is None:
            continue
        try:
            show(obj, obj.evaluated_get(depsgraph) if depsgraph is not None else None)
            obj.goffer_bend.fault = ""
        except Fault as fault:
            obj.goffer_bend.fault = str(fault)


# ---- Settings ----


def named(*names):
    return [(name, name.title(), text) for name, text in names]


PROFILE_ITEMS = named(("EVEN", "Folds of one depth, with round crests"),
                      ("DAMPED", "The paper's: deepest at mid-length, with creases"),
                      ("SMOOTH", "Deepest at mid-length, without creases"))
AMPLITUDE_ITEMS = named(("MESH", "The mesh keeps its area"), ("PAPER", "Lines along the base keep their lengths"),
                        ("AREA", "The base cylinder keeps its area"), ("NONE", "No wrinkles"))
AXIS_ITEMS = [("AUTO", "Automatic", "The mesh's long axis")] + [
    (axis, axis, "From base to tip, along the object's axis") for axis in AXES] + [
    ("CUSTOM", "Custom", "A vector from base to tip")]


class GofferBend(bpy.types.PropertyGroup):
    """What is kept with an object."""

    active: bpy.props.BoolProperty(options=set())
    made_basis: bpy.props.BoolProperty(options=set())
    facts: bpy.props.StringProperty()
    warnings: bpy.props.StringProperty()
    needs_rows: bpy.props.BoolProperty(options=set())
    fault: bpy.props.StringProperty()
    angles: bpy.props.FloatVectorProperty(
        name="Angle", description="From straight, for each region; at most the largest", size=MAX_REGIONS,
        unit="ROTATION", soft_min=-2 * math.pi, soft_max=2 * math.pi, update=follow)
    directions: bpy.props.FloatVectorProperty(
        name="Direction", description="Where it bends to, about its axis", size=MAX_REGIONS, unit="ROTATION",
        soft_min=-math.pi, soft_max=math.pi, update=follow)
    wrinkles: bpy.props.FloatProperty(name="Wrinkles", description="1: full; 0: none", default=1, min=0, max=1,
                                      subtype="FACTOR", update=follow)
    # What follows is chosen once: a body is bound anew where it changes, which takes longer than a frame.
    profile: bpy.props.EnumProperty(name="Profile", items=PROFILE_ITEMS, update=follow, options=set())
    roundness: bpy.props.FloatProperty(name="Roundness", description="Of the crests of even folds", default=0.25,
                                       min=0, max=0.5, update=follow, options=set())
    amplitude: bpy.props.EnumProperty(name="Depth", items=AMPLITUDE_ITEMS, description="What decides folds' depth",
                                      update=follow, options=set())
    folds: bpy.props.IntProperty(name="Folds", description="Of each region; -1: what suits it", default=-1, min=-1,
                                 max=512, soft_max=64, update=follow, options=set())
    fold_length: bpy.props.FloatProperty(name="Length", description="Of a fold, in radii; 0: the profile's own", min=0,
                                         soft_max=4, update=follow, options=set())
    wrinkle_first: bpy.props.FloatProperty(name="From", description="Below it the surface stays smooth", min=0,
                                           max=1, subtype="FACTOR", update=follow, options=set())
    wrinkle_last: bpy.props.FloatProperty(name="To", description="Above it the surface stays smooth", default=1,
                                          min=0, max=1, subtype="FACTOR", update=follow, options=set())
    mask: bpy.props.StringProperty(name="Where", description="A vertex group: its weights say how much each vertex "
                                   "wrinkles; empty: all of them fully", update=follow, options=set())
    onset: bpy.props.FloatProperty(name="Onset", description="Squeeze below which folds set in gently; -1: "
                                   "what suits the body", default=-1, min=-1, max=1, update=follow, options=set())
    axis: bpy.props.EnumProperty(name="Axis", items=AXIS_ITEMS, update=follow, options=set())
    axis_vector: bpy.props.FloatVectorProperty(name="Axis", default=(0, 0, 1), update=follow, options=set())
    straight: bpy.props.BoolProperty(name="Straight at Rest", description="Look for no arc in the rest shape",
                                     update=follow, options=set())
    one_radius: bpy.props.BoolProperty(name="One Radius", description="Take the body for a plain cylinder",
                                       update=follow, options=set())
    regions: bpy.props.StringProperty(name="Regions", description="Shares of the length that bend on their own, "
                                      "as 0.3, 0.4, 0.3; empty: one", update=follow, options=set())


class GofferPreferences(bpy.types.AddonPreferences):
    bl_idname = __name__

    library: bpy.props.StringProperty(name="Library", description="libgoffer.so, libgoffer.dylib or goffer.dll",
                                      subtype="FILE_PATH", update=lambda _self, _context: store.clear())

    def draw(self, _context):
        self.layout.prop(self, "library")
        lines(self.layout, library_fault() or "The library is found", 90)


def library_fault():
    try:
        store.library()
    except Fault as fault:
        return str(fault)
    return ""


# ---- Operators ----


class Operator(bpy.types.Operator):
    """What the add-on's operators share: a Fault is said, and nothing is done."""

    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        if context.object is not None and context.object.type == "MESH":
            return True
        if hasattr(cls, "poll_message_set"):  # from Blender 3.0 on
            cls.poll_message_set("Select a mesh object")
        return False

    def execute(self, context):
        try:
            return self.work(context, context.object) or {"FINISHED"}
        except Fault as fault:
            context.object.goffer_bend.fault = str(fault)
            self.report({"ERROR"}, str(fault))
            return {"CANCELLED"}

    def report_shared(self, actions):
        if actions:
            self.report({"INFO"}, "This animation stays in an action that others play, too: " +
                        ", ".join(sorted(actions)))


def need_active(obj):
    check_object(obj)
    if not obj.goffer_bend.active:
        raise Fault("Bend the object first")


class GOFFER_OT_bend(Operator):
    """Bend the active mesh; further sliders are in the sidebar"""

    bl_idname, bl_label = "object.goffer_bend", "Bend"

    angle: bpy.props.FloatProperty(name="Angle", subtype="ANGLE", default=math.pi / 2, soft_min=-2 * math.pi,
                                   soft_max=2 * math.pi, description="Regions share it by their lengths")
    direction: bpy.props.FloatProperty(name="Direction", subtype="ANGLE")
    wrinkles: bpy.props.FloatProperty(name="Wrinkles", default=1, min=0, max=1, subtype="FACTOR")
    profile: bpy.props.EnumProperty(name="Profile", items=PROFILE_ITEMS)
    amplitude: bpy.props.EnumProperty(name="Depth", items=AMPLITUDE_ITEMS)
    folds: bpy.props.IntProperty(name="Folds", default=-1, min=-1, max=512, soft_max=64)

    def invoke(self, context, _event):
        settings = context.object.goffer_bend
        for name in ("wrinkles", "profile", "amplitude", "folds"):
            setattr(self, name, getattr(settings, name))
        return self.execute(context)

    def work(self, _context, obj):
        settings = obj.goffer_bend
        check_object(obj)
        chosen = {name: getattr(self, name) for name in ("wrinkles", "profile", "amplitude", "folds")}
        before = {name: getattr(settings, name) for name in chosen}
        before.update((name, tuple(getattr(settings, name))) for name in ("angles", "directions"))
        was_active, settings.active = settings.active, False  # so that no slider follows
        try:
            for name, value in chosen.items():
                setattr(settings, name, value)
            for r, share in enumerate(shares_of(settings) or [1]):
                settings.angles[r], settings.directions[r] = self.angle * share, self.direction
            body, _ = body_of(obj)
            body.bend(poses_of(settings, body), settings.wrinkles)  # refuses what show() would
        except Exception:
            for name, value in before.items():
                setattr(settings, name, value)
            settings.active = was_active
            raise
        settings.active, settings.fault = True, ""
        self.report_shared(remove_baked(obj))
        show(obj)


class GOFFER_OT_update(Operator):
    """Bend the object anew, as its mesh and its weights are by now"""

    bl_idname, bl_label = "object.goffer_update", "Update"

    def work(self, _context, obj):
        need_active(obj)
        show(obj)
        obj.goffer_bend.fault = ""


class GOFFER_OT_reset(Operator):
    """Give the rest shape back, and remove the keys, the property and the animation of the sliders"""

    bl_idname, bl_label = "object.goffer_reset", "Reset"

    def work(self, _context, obj):
        check_object(obj)
        settings = obj.goffer_bend
        settings.active = False
        shared = remove_baked(obj, LIVE_KEY) | remove_sliders(obj)
        settings.facts = settings.warnings = settings.fault = ""
        settings.needs_rows = False
        store.trim()
        self.report_shared(shared)


def pose_between(rest, pose, t):
    """The pose at t of the way from rest. If the body is bent at rest, poses are vectors: angle times direction."""
    angle, direction = pose
    if rest.angle == 0:
        return t * angle, direction
    x, y = ((1 - t) * rest.angle * f(rest.direction) + t * angle * f(direction) for f in (math.cos, math.sin))
    return (angle, direction) if t == 1 else (math.hypot(x, y), math.atan2(y, x))


def drive(obj, key, k, count):
    """The key's weight from the custom property: a hat about k / count. Blender trusts so simple an expression."""
    driver = key.driver_add("value").driver
    variable = driver.variables.new()
    variable.name = "bent"
    variable.targets[0].id = obj
    variable.targets[0].data_path = f'["{BENT}"]'
    driver.type, driver.expression = "SCRIPTED", f"max(0, 1 - abs(bent * {count} - {k}))"


def set_linear(animated, path):
    curve = animated.animation_data.action.fcurves.find(path)
    for point in curve.keyframe_points:
        point.interpolation = "LINEAR"


def farthest(shapes, at, scale):
    """How far a vertex that moves straight from each shape to the next gets from where at(t) has it, t in [0, 1]."""
    count, parts = len(shapes) - 1, 10
    return max(np.linalg.norm((at((k + i / parts) / count) - shapes[k] * (1 - i / parts) - shapes[k + 1] * i / parts)
                              * scale, axis=1).max() for k in range(count) for i in range(1, parts))


class GOFFER_OT_bake(Operator):
    """Make shape keys from rest to the current pose, played by the custom property goffer_bent"""

    bl_idname, bl_label = "object.goffer_bake", "Bake to Shape Keys"

    count: bpy.props.IntProperty(name="Keys", description="The more, the closer between them", default=8, min=1,
                                 max=256)
    animate: bpy.props.BoolProperty(name="Animate", description="From rest to bent over the scene's frames",
                                    default=True)

    def work(self, context, obj):
        need_active(obj)
        body, scale = body_of(obj)
        target = poses_of(obj.goffer_bend, body)

        def at(t):
            poses = [pose_between(rest, pose, t) for rest, pose in zip(body.rest, target)]
            return body.bend(poses, obj.goffer_bend.wrinkles) / scale

        shapes = [rest_of(obj.data)]
        shapes += [at((k + 1) / self.count) for k in range(self.count)]
        off = farthest(shapes, at, scale) / np.ptp(shapes[0] * scale, axis=0).max()
        obj.goffer_bend.active = False
        own_action(obj)
        shared = remove_baked(obj, LIVE_KEY)
        obj[BENT] = 1.0
        if hasattr(obj, "id_properties_ui"):  # from Blender 3.0 on
            obj.id_properties_ui(BENT).update(min=0.0, max=1.0, description="0: at rest; 1: bent")
        for k in range(1, self.count + 1):
            drive(obj, add_key(obj, f"{BAKED_KEY}{k} of {self.count}", shapes[k]), k, self.count)
        if self.animate:
            for frame, value in ((context.scene.frame_start, 0.0), (context.scene.frame_end, 1.0)):
                obj[BENT] = value
                obj.keyframe_insert(f'["{BENT}"]', frame=frame)
            set_linear(obj, f'["{BENT}"]')
            context.scene.frame_set(context.scene.frame_current)
        obj.data.update()
        store.trim()
        obj.goffer_bend.fault = ""
        self.report_shared(shared)
        self.report({"INFO"}, f"{self.count} keys; between them a vertex is off by up to about "
                    f"{100 * off:.2g} % of the body's size")


class GOFFER_OT_bake_frames(Operator):
    """Make a shape key for each frame of the keyframed angles: what plays needs neither this add-on nor goffer"""

    bl_idname, bl_label = "object.goffer_bake_frames", "Bake Frames"

    start: bpy.props.IntProperty(name="First Frame", default=1)
    end: bpy.props.IntProperty(name="Last Frame", default=250)
    step: bpy.props.IntProperty(name="Step", description="Frames from key to key; the last frame has one in any case",
                              default=1, min=1)

    def invoke(self, context, _event):
        self.start, self.end = context.scene.frame_start, context.scene.frame_end
        return context.window_manager.invoke_props_dialog(self)

    def work(self, context, obj):
        need_active(obj)
        frames = list(range(self.start, self.end, self.step)) + [self.end] * (self.start <= self.end)
        if not 2 <= len(frames) <= 1000:
            raise Fault(f"{len(frames)} frames are to be baked: take 2 to 1000, or another step")
        shapes, poses = self.shapes(context, obj, frames)
        if all(pose == poses[0] for pose in poses):
            raise Fault("Nothing moves in these frames: put keyframes on an angle first (I, over its slider)")
        obj.goffer_bend.active = False
        if obj.data.shape_keys is not None:
            own_action(obj.data.shape_keys)
        shared = remove_baked(obj, LIVE_KEY)
        for i, (frame, shape) in enumerate(zip(frames, shapes)):
            key = add_key(obj, f"{FRAME_KEY}{frame}", shape)
            for near, value in ((i - 1, 0.0), (i, 1.0), (i + 1, 0.0)):
                if 0 <= near < len(frames):
                    key.value = value
                    key.keyframe_insert("value", frame=frames[near])
            set_linear(obj.data.shape_keys, key.path_from_id("value"))
        store.trim()
        obj.goffer_bend.fault = ""
        context.scene.frame_set(context.scene.frame_current)
        self.report_shared(shared)
        self.report({"INFO"}, f"{len(frames)} keys for frames {frames[0]} to {frames[-1]}")

    @staticmethod
    def shapes(context, obj, frames):
        current, shapes, poses = context.scene.frame_current, [], []
        try:
            for frame in frames:
                context.scene.frame_set(frame)
                settings = obj.evaluated_get(context.evaluated_depsgraph_get()).goffer_bend
                body, scale = body_of(obj)
                poses.append((poses_of(settings, body), settings.wrinkles))
                shapes.append(body.bend(*poses[-1]) / scale)
        finally:
            context.scene.frame_set(current)
        return shapes, poses


class Heights:
    """Where points stand along the axis or the rest arc of a base, and the planes across it."""

    def __init__(self, base):
        self.base = base
        self.origin, self.axis, zero = (np.array(v) for v in (base.origin, base.axis, base.zero))
        self.side = math.cos(base.rest_direction) * zero + math.sin(base.rest_direction) * np.cross(self.axis, zero)
        if base.rest_angle:
            self.radius = base.length / base.rest_angle - base.radius
            self.center = self.origin + self.radius * self.side

    def of(self, points):
        if not self.base.rest_angle:
            return (points - self.origin) @ self.axis
        away, half = points - self.center, self.base.rest_angle / 2
        angle = np.arctan2(away @ self.axis, -(away @ self.side))
        angle = np.mod(angle - half + math.pi, 2 * math.pi) + half - math.pi
        return angle * self.base.length / self.base.rest_angle

    def plane(self, height):
        """A point of it and its normal."""
        if not self.base.rest_angle:
            return self.origin + height * self.axis, self.axis
        angle = height * self.base.rest_angle / self.base.length
        out = math.cos(angle) * self.side - math.sin(angle) * self.axis
        return self.center - self.radius * out, math.cos(angle) * self.axis + math.sin(angle) * self.side


def row_heights(body, settings, times):
    """Where rows of vertices should be: eight for each fold that suits the body, `times` as many."""
    shares, heights, below = shares_of(settings) or [1], [], 0
    for share, folds in zip(shares, body.folds):
        wanted = settings.folds if settings.folds > 0 else folds.suitable
        rows = max(1, math.ceil(times * wanted * (8 if settings.profile == "EVEN" else 16)))
        heights += [(below + share * i / rows) * body.base.length for i in range(rows)]
        below += share
    return np.array(heights[1:])


class Cutter:
    """Cuts the faces that reach over more than a row. Halves of the rows are cut in turn, so that few faces are
    looked at for each."""

    MOST_FACES = 1_000_000

    def __init__(self, edit, base, scale, rows):
        self.edit, self.places, self.scale, self.rows = edit, Heights(base), scale, rows
        self.dist = 1e-6 * base.length
        around = np.concatenate(([0], rows, [base.length]))
        self.steps = np.minimum(np.diff(around)[:-1], np.diff(around)[1:])
        self.heights = dict(zip(edit.verts, self.places.of(np.array([v.co for v in edit.verts]) * scale)))

    def span(self, face):
        heights = []
        for vertex in face.verts:
            if vertex not in self.heights:
                self.heights[vertex] = self.places.of(np.array(vertex.co) * self.scale)
            heights.append(self.heights[vertex])
        return min(heights), max(heights)

    def cut(self, faces, first, last):
        """At the rows from `first` up to `last`."""
        if first >= last or not faces:
            return
        middle = (first + last) // 2
        row, spans = self.rows[middle], [self.span(face) for face in faces]
        faces += self.bisect([face for face, (low, high) in zip(faces, spans) if low + 2 * self.dist < row <
                              high - 2 * self.dist and high - low > 1.001 * self.steps[middle]], row)
        faces = list(dict.fromkeys(faces))
        spans = [self.span(face) for face in faces]
        self.cut([face for face, (low, _) in zip(faces, spans) if low < row - 2 * self.dist], first, middle)
        self.cut([face for face, (_, high) in zip(faces, spans) if high > row + 2 * self.dist], middle + 1, last)

    def bisect(self, faces, row):
        """Returns the pieces."""
        if not faces:
            return []
        point, normal = self.places.plane(row)
        parts = dict.fromkeys(part for face in faces for part in (*face.verts, *face.edges))
        made = bmesh.ops.bisect_plane(self.edit, geom=[*parts, *faces], dist=self.dist,
                                      plane_co=point / self.scale, plane_no=normal * self.scale)
        if len(self.edit.faces) > self.MOST_FACES:
            raise Fault("The mesh would have more than a million faces: ask for fewer folds, or subdivide it by hand")
        return [part for part in made["geom"] if isinstance(part, bmesh.types.BMFace)]


def cut_rows(uncut, body, scale, rows):
    """A copy of `uncut` with the rows."""
    edit = uncut.copy()
    try:
        Cutter(edit, body.base, scale, rows).cut(list(edit.faces), 0, len(rows))
    except Fault:
        edit.free()
        raise
    return edit


class GOFFER_OT_add_rows(Operator):
    """Cut long faces across the body until the mesh carries its folds; the rest shape stays"""

    bl_idname, bl_label = "object.goffer_add_rows", "Add Rows"

    def work(self, _context, obj):
        need_active(obj)
        before = len(obj.data.vertices)
        if not self.cut(obj):
            self.report({"INFO"}, "The mesh has vertices for its folds: no rows are needed")
            return
        show(obj)
        obj.goffer_bend.fault = ""
        self.report({"INFO"}, f"{before} vertices before, {len(obj.data.vertices)} with the new rows")

    @staticmethod
    def cut(obj):
        """Tries rows on a mesh aside, and gives the object those that make the most folds. False: none are needed."""
        settings, (body, scale) = obj.goffer_bend, body_of(obj)

        def lacking():
            return any(lacks_folds(folds, settings) for folds in body.folds)

        def carried():
            return sum(min(folds.capacity, settings.folds) if settings.folds > 0 else folds.made
                       for folds in body.folds)

        if not lacking():
            return False
        uncut, kept, most, trial = bmesh.new(), None, carried(), bpy.data.meshes.new("goffer rows")
        held = [uncut]
        try:
            uncut.from_mesh(obj.data)
            for times in (1, 1.25, 1.5, 2, 4):  # thin parts have shorter folds
                held.append(cut_rows(uncut, body, scale, row_heights(body, settings, times)))
                held[-1].to_mesh(trial)
                body, _ = body_of(obj, trial)
                if carried() > most:
                    most, kept = carried(), held[-1]
                for edit in [edit for edit in held[1:] if edit is not kept]:
                    held.remove(edit)
                    edit.free()
                if not lacking():
                    break
            if kept is None:
                raise Fault("More rows make no more folds" + (": From and To leave too little of the length"
                                                              if is_ranged(settings) else " in this mesh"))
            kept.to_mesh(obj.data)
        finally:
            for edit in held:
                edit.free()
            bpy.data.meshes.remove(trial)
        return True


# ---- The panel ----


def lines(layout, text, width, icon="NONE"):
    """Labels do not wrap by themselves."""
    column = layout.column(align=True)
    column.scale_y = 0.8
    for paragraph in text.splitlines():
        for i, line in enumerate(textwrap.wrap(paragraph, width)):
            column.label(text=line, icon=icon if i == 0 else "BLANK1" if icon != "NONE" else "NONE")


class Panel(bpy.types.Panel):
    """What panels share."""

    bl_space_type, bl_region_type, bl_category = "VIEW_3D", "UI", "goffer"

    @staticmethod
    def prepared(layout, animated=False):
        layout.use_property_split, layout.use_property_decorate = True, animated
        return layout.column()


class GOFFER_PT_panel(Panel):
    bl_idname, bl_label = "GOFFER_PT_panel", "goffer bend"

    def draw(self, context):
        layout, obj = self.layout, context.object
        width = max(20, int(context.region.width / (7 * context.preferences.system.ui_scale)) - 6)
        fault = library_fault()
        if fault:
            lines(layout, fault, width, "ERROR")
            return
        if obj is None or obj.type != "MESH":
            lines(layout, "Select a mesh object", width)
            return
        settings = obj.goffer_bend
        row = layout.row(align=True)
        row.operator("object.goffer_bend")
        row.operator("object.goffer_reset")
        if settings.fault:
            lines(layout, settings.fault, width, "ERROR")
        if settings.active:
            self.draw_pose(self.prepared(layout, animated=True), settings)
            if settings.warnings:
                lines(layout, settings.warnings, width, "INFO")
            if settings.needs_rows:
                layout.operator("object.goffer_add_rows")
            layout.operator("object.goffer_bake")
            layout.operator("object.goffer_bake_frames")
            lines(layout, settings.facts, width)
        elif BENT in obj:
            layout.prop(obj, f'["{BENT}"]', text="Bent", slider=True)

    @staticmethod
    def draw_pose(column, settings):
        count = min(MAX_REGIONS, len(settings.regions.replace(",", " ").split()) or 1)
        for r in range(count):
            number = f" {r + 1}" if count > 1 else ""
            column.prop(settings, "angles", index=r, text="Angle" + number)
            column.prop(settings, "directions", index=r, text="Toward" + number)
        column.prop(settings, "wrinkles", slider=True)


class SubPanel(Panel):
    """Further settings of an object that is bent."""

    bl_parent_id, bl_options = "GOFFER_PT_panel", {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        obj = context.object
        return obj is not None and obj.type == "MESH" and obj.goffer_bend.active


class GOFFER_PT_folds(SubPanel):
    bl_idname, bl_label = "GOFFER_PT_folds", "Folds"

    def draw(self, context):
        column, settings = self.prepared(self.layout), context.object.goffer_bend
        for name in ("amplitude", "folds", "fold_length", "profile"):
            column.prop(settings, name)
        if settings.profile == "EVEN":
            column.prop(settings, "roundness")
        for name in ("onset", "wrinkle_first", "wrinkle_last"):
            column.prop(settings, name)
        column.prop_search(settings, "mask", context.object, "vertex_groups")
        if settings.mask:  # weights are read when it is bent, not while they are painted
            column.operator("object.goffer_update")


class GOFFER_PT_body(SubPanel):
    bl_idname, bl_label = "GOFFER_PT_body", "Body"

    def draw(self, context):
        column, settings = self.prepared(self.layout), context.object.goffer_bend
        column.prop(settings, "axis")
        if settings.axis == "CUSTOM":
            column.prop(settings, "axis_vector", text="")
        for name in ("regions", "straight", "one_radius"):
            column.prop(settings, name)


CLASSES = (GofferBend, GofferPreferences, GOFFER_OT_bend, GOFFER_OT_update, GOFFER_OT_reset, GOFFER_OT_bake,
           GOFFER_OT_bake_frames, GOFFER_OT_add_rows, GOFFER_PT_panel, GOFFER_PT_folds, GOFFER_PT_body)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.Object.goffer_bend = bpy.props.PointerProperty(type=GofferBend)
    bpy.app.handlers.frame_change_post.append(follow_frame)


def unregister():
    bpy.app.handlers.frame_change_post.remove(follow_frame)
    del bpy.types.Object.goffer_bend
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
    store.clear()


if __name__ == "__main__":
    register()
