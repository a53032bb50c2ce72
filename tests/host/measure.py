"""Measures surfaces by other formulas than the library's, in numpy."""
import numpy as np

# Second moments of the tetrahedron with corners 0, e_x, e_y, e_z.
UNIT_TETRAHEDRON = (np.ones((3, 3)) + np.eye(3)) / 120.0


def body(vertices, faces, density):
    """Mass, first and second moments about the origin: tetrahedra to the origin, each the affine
    image of the unit one."""
    corners = vertices[faces].transpose(0, 2, 1)  # one matrix a face, its corners the columns
    determinant = np.linalg.det(corners)
    volume = determinant.sum() / 6.0
    first = (determinant[:, None] * corners.sum(axis=2)).sum(axis=0) / 24.0
    second = np.einsum("f,fij,jk,flk->il", determinant, corners, UNIT_TETRAHEDRON, corners)
    return density * volume, density * first, density * second


def mass_properties(parts):
    """Mass, centre of mass and inertia tensor about it of the sum of `body` results."""
    mass = sum(p[0] for p in parts)
    centre = sum(p[1] for p in parts) / mass
    second = sum(p[2] for p in parts) - mass * np.outer(centre, centre)
    return mass, centre, np.trace(second) * np.eye(3) - second


def hollow_body(outer, inner, density, fill_density=0.0, reference=np.zeros(3)):
    """Mass (g), centre and inertia of outer + inner surface; `inner` points into the cavity."""
    parts = [body(v - reference, f, d / 1000.0)
             for (v, f), d in ((outer, density), (inner, density - fill_density))
             if len(f)]
    mass, centre, inertia = mass_properties(parts)
    return mass, centre + reference, inertia


def edges_match(faces):
    """Whether every directed edge has its opposite exactly once: closed and oriented."""
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    forward = {tuple(e) for e in edges}
    return len(forward) == len(edges) and all((b, a) in forward for a, b in forward)


def convex_hull(points):
    """Corners of the convex hull in the plane, counter-clockwise (monotone chain)."""
    points = sorted(map(tuple, points))

    def chain(sequence):
        hull = []
        for p in sequence:
            while len(hull) > 1 and np.cross(np.subtract(hull[-1], hull[-2]),
                                             np.subtract(p, hull[-2])) <= 0:
                hull.pop()
            hull.append(p)
        return hull[:-1]

    return np.array(chain(points) + chain(points[::-1]))


def contact_polygon(vertices):
    """Hull of the points on the ground, up = +z."""
    lowest = vertices[:, 2].min()
    diagonal = np.linalg.norm(np.ptp(vertices, axis=0))
    return convex_hull(vertices[vertices[:, 2] <= lowest + 1e-4 * diagonal][:, :2])


def polygon_centroid(polygon):
    following = np.roll(polygon, -1, axis=0)
    cross = polygon[:, 0] * following[:, 1] - polygon[:, 1] * following[:, 0]
    return ((polygon + following) * cross[:, None]).sum(axis=0) / (3.0 * cross.sum())


def section_area(surface, point, normal):
    """Area that the plane cuts out of what the closed, outward oriented surface encloses."""
    vertices, faces = surface
    u = np.cross(normal, [0.3, 0.5, 0.7])
    u /= np.linalg.norm(u)
    flat = (vertices - point) @ np.stack([u, np.cross(normal, u)], axis=1)
    side = (vertices - point) @ normal
    area = 0.0
    for a, b, c in faces[np.ptp(np.sign(side)[faces], axis=1) > 0]:
        ends = []
        for p, q in ((a, b), (b, c), (c, a)):
            if (side[p] <= 0) != (side[q] <= 0):
                cut = (side[q] * flat[p] - side[p] * flat[q]) / (side[q] - side[p])
                ends.append((side[p] <= 0, cut))
        if len(ends) == 2:
            (_, start), (_, end) = sorted(ends, key=lambda e: e[0])
            area += (start[0] * end[1] - start[1] * end[0]) / 2
    return abs(area)


def tipping_angle(vertices, centre):
    """Degrees: from the distance of the centre of mass to the nearest edge of the contact polygon,
    negative outside of it. Up = +z."""
    polygon = contact_polygon(vertices)
    start, end = polygon, np.roll(polygon, -1, axis=0)
    along = end - start
    offset = centre[:2] - start
    inside = (along[:, 0] * offset[:, 1] - along[:, 1] * offset[:, 0]).min() > 0
    t = np.clip((offset * along).sum(axis=1) / (along**2).sum(axis=1), 0, 1)
    distance = np.linalg.norm(offset - t[:, None] * along, axis=1).min()
    height = centre[2] - vertices[:, 2].min()
    return np.degrees(np.arctan2(distance if inside else -distance, height))


def spin_measures(vertices, centre, inertia):
    """Axis offset, axis tilt (degrees), I_zz/I_a, I_zz/I_b with I_a ≥ I_b. Up = +z."""
    pivot = polygon_centroid(contact_polygon(vertices))
    _, axes = np.linalg.eigh(inertia)
    tilt = np.degrees(np.arccos(min(1.0, np.abs(axes[2]).max())))
    low, high = np.linalg.eigvalsh(inertia[:2, :2])
    return np.linalg.norm(centre[:2] - pivot), tilt, inertia[2, 2] / high, inertia[2, 2] / low


def growth_of_top(bottom, centre, inertia, mass, rpm):
    """How fast a disturbance grows of a top that turns upright on its tip at z = `bottom`: the largest
    real part of the eigenvalues of Euler's equations, in turns of the top. Millimetres and grams."""
    height, turn = centre[2] - bottom, rpm * np.pi / 30
    a, b = np.linalg.eigvalsh(inertia[:2, :2]) + mass * height**2
    c, weight = inertia[2, 2], mass * 9806.65 * height / turn**2
    return np.linalg.eigvals([[0, (b - c) / a, 0, weight / a], [(c - a) / b, 0, -weight / b, 0],
                              [0, -1, 0, 1], [1, 0, -1, 0]]).real.max()


def below(surface, level, slices=400):
    """Volume and centre of what lies below z = level: areas of horizontal cuts, added up."""
    vertices, faces = surface
    triangles = vertices[faces]
    bottom = vertices[:, 2].min()
    heights = bottom + (np.arange(slices) + 0.5) / slices * (level - bottom)
    middle = vertices.mean(axis=0)[:2]
    area, first = np.zeros(slices), np.zeros((slices, 2))
    for i, z in enumerate(heights):
        cut = triangles[(triangles[:, :, 2].min(axis=1) < z) & (triangles[:, :, 2].max(axis=1) > z)]
        ends = []
        for k in range(3):  # where the boundary enters, and where it leaves
            p, q = cut[:, k], cut[:, (k + 1) % 3]
            t = (z - p[:, 2]) / np.where(q[:, 2] == p[:, 2], np.nan, q[:, 2] - p[:, 2])
            point = p[:, :2] + t[:, None] * (q - p)[:, :2] - middle
            ends.append((point, (p[:, 2] > z) & (q[:, 2] <= z), (p[:, 2] <= z) & (q[:, 2] > z)))
        a = sum(np.where(down[:, None], np.nan_to_num(point), 0) for point, down, _ in ends)
        b = sum(np.where(up[:, None], np.nan_to_num(point), 0) for point, _, up in ends)
        cross = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
        area[i] = cross.sum() / 2
        first[i] = ((a + b) * cross[:, None]).sum(axis=0) / 6
    step = (level - bottom) / slices
    volume = area.sum() * step
    return volume, np.append(first.sum(axis=0) * step / volume + middle,
                             (area * heights).sum() * step / volume)


def point_triangle_distances(p, a, b, c):
    """Distance of each point to its triangle: to the plane where its foot is inside, else to the
    nearest side."""
    normal = np.cross(b - a, c - a)
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    best = np.full(len(p), np.inf)
    inside = np.ones(len(p), bool)
    for q, r in ((a, b), (b, c), (c, a)):
        side = r - q
        t = np.clip(((p - q) * side).sum(1) / (side**2).sum(1), 0, 1)
        best = np.minimum(best, np.linalg.norm(p - q - t[:, None] * side, axis=1))
        inside &= (np.cross(side, p - q) * normal).sum(1) >= 0
    return np.where(inside, np.abs(((p - a) * normal).sum(1)), best)


def segment_distances(p, q, r, s):
    """Distance of each segment pq to its segment rs: between the lines where both feet are inside,
    else from an end to the other segment."""
    def to_segment(x, a, b):
        t = np.clip(((x - a) * (b - a)).sum(1) / ((b - a) ** 2).sum(1), 0, 1)
        return np.linalg.norm(x - a - t[:, None] * (b - a), axis=1)

    best = np.minimum.reduce([to_segment(p, r, s), to_segment(q, r, s),
                              to_segment(r, p, q), to_segment(s, p, q)])
    u, v, w = q - p, s - r, p - r
    a, b, c = (u * u).sum(1), (u * v).sum(1), (v * v).sum(1)
    d, e = (u * w).sum(1), (v * w).sum(1)
    with np.errstate(divide="ignore", invalid="ignore"):
        denominator = a * c - b * b
        t, k = (b * e - c * d) / denominator, (a * e - b * d) / denominator
        between = np.linalg.norm(w + t[:, None] * u - k[:, None] * v, axis=1)
        proper = (denominator > 1e-12 * a * c) & (t >= 0) & (t <= 1) & (k >= 0) & (k <= 1)
    return np.where(proper, np.minimum(best, between), best)


def surface_distance(one, other):
    """Least distance between two surfaces: all pairs of triangles whose bounding balls are nearer
    than the nearest pair of centres could be."""
    triangles = [v[f] for v, f in (one, other)]
    centres = [t.mean(axis=1) for t in triangles]
    radii = [np.linalg.norm(t - c[:, None], axis=2).max(axis=1) for t, c in zip(triangles, centres)]
    origin = centres[0].mean(axis=0)
    a, b = (c - origin for c in centres)
    squares = (b**2).sum(1)

    def chunks():
        for start in range(0, len(a), 500):
            piece = a[start:start + 500]
            yield start, np.sqrt(np.maximum(
                (piece**2).sum(1)[:, None] + squares - 2.0 * piece @ b.T, 0.0))

    limit = min(distance.min() for _, distance in chunks())
    best = limit
    for start, distance in chunks():
        reach = distance - radii[0][start:start + 500, None] - radii[1]
        i, j = np.nonzero(reach < best)
        p, q = triangles[0][start + i], triangles[1][j]
        for step in range(0, len(i), 100000):
            x, y = p[step:step + 100000], q[step:step + 100000]
            for k in range(3):
                best = min(best, point_triangle_distances(x[:, k], *y.transpose(1, 0, 2)).min(),
                           point_triangle_distances(y[:, k], *x.transpose(1, 0, 2)).min())
                for m in range(3):
                    best = min(best, segment_distances(x[:, k], x[:, (k + 1) % 3], y[:, m],
                                                       y[:, (m + 1) % 3]).min())
    return best
