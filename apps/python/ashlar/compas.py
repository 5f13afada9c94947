"""COMPAS: models in, verdict, forces and transformations out.

    import ashlar.compas
    answer = ashlar.compas.solve("vault.json")     # what compas.json_dump wrote: a Problem, BlockModel or Assembly
    print(answer.status, answer.transformations["4"])
    answer.write("vault_results.json")             # compas.json_load reads it: the model with its results

    problem.add_gravity()                          # in a program of compas_dem
    ashlar.compas.solve_problem(problem)           # sets the results in problem.model.graph

Results are attributes of the graph, as compas_dem's own solvers write them. Of each node `transformation`. Of each edge
(u, v) whose blocks are in contact `contact_point`, `force_vector` and `force` (N, on u), `force_magnitude`, `force_normal`,
`force_tangent1`, `force_tangent2`, `gap`, `status`, and `contact_data`: a FrictionContact whose frame has its z axis from u
to v and whose forces c_np, c_nn, c_u and c_v act on v. An Assembly has `interfaces` instead of it. Nothing of COMPAS is
needed but by solve_problem.
"""

import collections as _collections
import json as _json
import pathlib as _pathlib
import tempfile as _tempfile

import numpy as _numpy

from . import Scene as _Scene
from . import _core

__all__ = ["Answer", "Interface", "solve", "solve_problem"]

_PREFIX = "block."
_STATUS = {1: "stick", 2: "slide"}

Interface = _collections.namedtuple("Interface", ["blocks", "points", "normal", "tangents", "forces", "gaps", "status", "area"])
Interface.__doc__ = """Contact points of two blocks on one plane. blocks: numbers of their nodes (u, v); points: (n, 3), m, in their order
around the centre; normal: from u to v; tangents: (2, 3), right-handed with the normal: t1 x t2 = normal; forces: (n, 3), N, on u;
gaps: (n), m; status: n words, stick or slide; area: m^2."""


class Answer:
    """The answer for a model.

    status: equilibrium, moving or not converged; message: the motion found; summary: the content of summary.json;
    left_out: parts of the model that were not read, and assumptions; transformations: {node: 4 x 4 array}, from the place in
    the model to that at the end; interfaces: a list of Interface.
    """

    def __init__(self, model, simulation, corners, notes):
        self._model = model
        self.status = simulation.status
        self.message = simulation.message
        self.summary = simulation.summary
        self.left_out = notes
        self.transformations = {node: _transformation(simulation.blocks[_PREFIX + node], points)
                                for node, points in corners.items()}
        self.interfaces = _interfaces(simulation)

    def to_dict(self):
        """The model with the results, as values of JSON."""
        model = _json.loads(_json.dumps(self._model))
        graph, is_assembly = _graph(model)
        if graph is None:
            raise ValueError("the model has no graph, a Problem, BlockModel or Assembly is needed")
        for node, matrix in self.transformations.items():
            graph["node"][node]["transformation"] = _object("compas.geometry/Transformation", {"matrix": matrix.tolist()})
        by_edge = _collections.defaultdict(list)
        for interface in self.interfaces:
            by_edge[interface.blocks].append(interface)
        for (u, v), interfaces in by_edge.items():
            attributes = _edge(graph, u, v)
            if attributes is None:
                attributes = _edge(graph, v, u)
                interfaces = [_reversed(interface) for interface in interfaces] if attributes is not None else interfaces
            if attributes is None:
                attributes = graph.setdefault("edge", {}).setdefault(u, {}).setdefault(v, {})
                adjacency = graph.get("adjacency")
                if adjacency is not None:
                    adjacency.setdefault(u, {})[v] = None
                    adjacency.setdefault(v, {})[u] = None
            attributes.update(_assembly_attributes(interfaces) if is_assembly else _edge_attributes(interfaces))
        return model

    def write(self, path):
        """Writes the model with the results as JSON, which compas.json_load reads."""
        _pathlib.Path(path).write_text(_json.dumps(self.to_dict()), encoding="utf-8")

    def __repr__(self):
        return f"<ashlar.compas.Answer {self.status}, {len(self.transformations)} blocks, {len(self.interfaces)} interfaces>"


def solve(model, fixed=(), threads=1, overrides=()):
    """Solves a model of COMPAS by a static analysis of rigid blocks.

    model: the path of a JSON file, or its values (a dictionary). fixed: numbers of nodes that never move, besides the
    supports of the model. overrides: texts "key.path=value" for the scene, such as "contact.friction_angle=35".
    Raises ValueError for a model that cannot be read, or cannot be analysed: blocks without support, and, as ashlar.SceneError,
    blocks that overlap or are open. Raises RuntimeError if the analysis fails.
    """
    with _tempfile.TemporaryDirectory() as folder:
        place = _pathlib.Path(folder)
        if isinstance(model, (dict, list)):
            values = model
            file = place / "model.json"
            file.write_text(_json.dumps(values), encoding="utf-8")
        else:
            file = _pathlib.Path(model)
            values = None
        arguments = ["import", str(file), "--out", str(place / "scene.toml")]
        if len(fixed) > 0:
            arguments += ["--fixed", ",".join(str(node) for node in fixed)]
        status, text = _core.command(arguments)
        if status != 0:
            raise ValueError(text.strip())
        if values is None:
            values = _json.loads(file.read_text(encoding="utf-8"))
        simulation = _Scene.load(place / "scene.toml", overrides).simulation(threads)
        simulation.run()
        notes = [line.split(": ", 1)[1] for line in text.splitlines()
                 if line.startswith(("ashlar: left out: ", "ashlar: note: "))]
        return Answer(values, simulation, _corners(place / "scene.obj"), notes)


def solve_problem(problem, fixed=(), threads=1, overrides=()):
    """Solves a Problem or BlockModel of compas_dem, or an Assembly of compas_assembly, and sets the results in its graph: see the
    head of this module. Returns the Answer; the other arguments are those of solve. Needs COMPAS."""
    import compas

    answer = solve(_json.loads(compas.json_dumps(problem)), fixed, threads, overrides)
    solved, _ = _graph(answer.to_dict())
    graph = getattr(problem, "model", problem).graph
    for node in list(graph.nodes()):
        written = solved["node"][str(node)]["transformation"]
        graph.node_attribute(node, "transformation", compas.json_loads(_json.dumps(written)))
    for u, others in solved.get("edge", {}).items():
        for v, attributes in others.items():
            edge = (_node(graph, u), _node(graph, v))
            if not attributes:
                continue
            if not graph.has_edge(edge):
                graph.add_edge(*edge)
            for name in _RESULTS & attributes.keys():
                graph.edge_attribute(edge, name, compas.json_loads(_json.dumps(attributes[name])))
    return answer


def _node(graph, text):
    return next(node for node in graph.nodes() if str(node) == text)


def _object(kind, data):
    return {"dtype": kind, "data": data}


def _content(value):
    for key in ("data", "value", "data"):
        if isinstance(value, dict) and key in value and "node" not in value:
            value = value[key]
    return value


def _graph(model):
    """The values of the graph in those of a model, and True for an Assembly; None without a graph."""
    content = _content(model)
    if not isinstance(content, dict):
        return None, False
    if "model" in content:
        return _graph(content["model"])
    if "node" in content:
        return content, True
    if "graph" not in content:
        return None, False
    return _content(content["graph"]), "elements" not in content


def _edge(graph, u, v):
    others = graph.get("edge", {}).get(u)
    attributes = None if others is None else others.get(v)
    if attributes is None and others is not None and v in others:
        attributes = others[v] = {}
    return attributes


def _corners(file):
    """Points of the blocks of an OBJ file by name."""
    corners = {}
    for line in file.read_text(encoding="utf-8").splitlines():
        words = line.split()
        if words[0] == "o":
            points = corners[words[1]] = []
        elif words[0] == "v":
            points.append([float(word) for word in words[1:]])
    return corners


def _transformation(block, corners):
    """The rigid motion of the corners of a block: their centre moves, and the rotation is the polar factor of the matrix that
    maps corners about it to where they are."""
    corners = _numpy.array(corners)
    placed = _numpy.asarray(block.positions(corners))
    before, after = corners.mean(axis=0), placed.mean(axis=0)
    left, _, right = _numpy.linalg.svd((placed - after).T @ (corners - before))
    mirrored = _numpy.linalg.det(left @ right) < 0
    matrix = _numpy.eye(4)
    matrix[:3, :3] = left @ _numpy.diag([1, 1, -1 if mirrored else 1]) @ right
    matrix[:3, 3] = after - matrix[:3, :3] @ before
    return matrix


def _interfaces(simulation):
    """Closed contact points by pairs of blocks and planes."""
    names = simulation.blocks.keys()
    points = simulation.contacts()
    points = points[points["state"] > 0]
    if len(points) == 0:
        return []
    size = float(_numpy.linalg.norm(_numpy.ptp(points["place"], axis=0))) or 1.0
    groups = _collections.defaultdict(list)
    for point in points:
        pair = groups[(int(point["a"]), int(point["b"]))]
        for group in pair:
            first = group[0]
            parallel = float(first["normal"] @ point["normal"]) > 1 - 1e-6
            apart = abs(float(first["normal"] @ (point["place"] - first["place"])))
            if parallel and apart < 1e-4 * size:
                group.append(point)
                break
        else:
            pair.append([point])
    return [_interface(names[a][len(_PREFIX):], names[b][len(_PREFIX):], _numpy.array(group))
            for (a, b), pair in groups.items() for group in pair]


def _interface(u, v, points):
    # Normals of the points are out of v.
    normal = -points["normal"].mean(axis=0)
    normal /= _numpy.linalg.norm(normal)
    axis = _numpy.eye(3)[_numpy.argmin(abs(normal))]
    first = _numpy.cross(axis, normal)
    first /= _numpy.linalg.norm(first)
    second = _numpy.cross(normal, first)
    places = points["place"]
    around = places - places.mean(axis=0)
    order = _numpy.argsort(_numpy.arctan2(around @ second, around @ first), kind="stable")
    points = points[order]
    return Interface((u, v), points["place"], normal, _numpy.array([first, second]), points["force"], points["gap"],
                     [_STATUS[int(state)] for state in points["state"]], float(points["area"].sum()))


def _reversed(interface):
    """The same seen from the other block; exchanged tangents are right-handed with the reversed normal."""
    u, v = interface.blocks
    return interface._replace(blocks=(v, u), normal=-interface.normal, tangents=interface.tangents[::-1],
                              forces=-interface.forces)


def _frame(interface):
    return _object("compas.geometry/Frame", {"point": interface.points.mean(axis=0).tolist(),
                                             "xaxis": interface.tangents[0].tolist(),
                                             "yaxis": interface.tangents[1].tolist()})


def _components(interface):
    """Forces on v along the frame: compression c_np and tension c_nn, shear c_u and c_v."""
    forces = []
    for force in -interface.forces:
        normal = float(force @ interface.normal)
        forces.append({"c_np": max(normal, 0.0), "c_nn": max(-normal, 0.0),
                       "c_u": float(force @ interface.tangents[0]), "c_v": float(force @ interface.tangents[1])})
    return forces


def _points(interface):
    return [_object("compas.geometry/Point", point.tolist()) for point in interface.points]


_RESULTS = frozenset(["contact_point", "force_vector", "force", "force_magnitude", "force_normal", "force_tangent1",
                      "force_tangent2", "gap", "status", "contact_data", "contact_polygon", "contact_frame", "face_contact",
                      "edge_contact", "point_contact", "interfaces"])


def _edge_attributes(interfaces):
    """As of compas_dem: a pair with several interfaces has the points of all, and the contact of that with most points."""
    components = [force for interface in interfaces for force in _components(interface)]
    largest = max(interfaces, key=lambda interface: len(interface.points))
    total = sum(interface.forces.sum(axis=0) for interface in interfaces)
    count = len(largest.points)
    attributes = {
        "contact_point": [point for interface in interfaces for point in interface.points.tolist()],
        "force_vector": [force for interface in interfaces for force in interface.forces.tolist()],
        "force": total.tolist(),
        "force_magnitude": float(_numpy.linalg.norm(total)),
        "force_normal": [force["c_np"] - force["c_nn"] for force in components],
        "force_tangent1": [force["c_u"] for force in components],
        "force_tangent2": [force["c_v"] for force in components],
        "gap": [gap for interface in interfaces for gap in interface.gaps.tolist()],
        "status": [word for interface in interfaces for word in interface.status],
        "face_contact": count >= 3, "edge_contact": count == 2, "point_contact": count == 1,
        "contact_frame": _frame(largest),
    }
    if count >= 3:
        attributes["contact_polygon"] = _object("compas.geometry/Polygon", {"points": largest.points.tolist()})
        attributes["contact_data"] = _object("compas_dem.interactions/FrictionContact", {
            "points": _points(largest), "frame": _frame(largest), "size": largest.area, "mesh": None,
            "name": "FrictionContact", "forces": _components(largest)})
    return attributes


def _assembly_attributes(interfaces):
    return {"interfaces": [_object("compas_assembly.datastructures/Interface", {
        "points": _points(interface), "size": interface.area, "frame": _frame(interface), "mesh": None,
        "forces": _components(interface)}) for interface in interfaces]}
