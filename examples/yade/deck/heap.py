# The lifted-cylinder heap test for YADE, SI units. talus fills in what stands in double braces.
# Contact: Ip2_FrictMat_FrictMat_MindlinPhys with one restitution in both directions. Rolling: krot is
# a constant, that of two grains which bear ten grain weights (R1 of docs/physics.md); the moment is
# limited by eta (R1 + R2)/2 |F_n|, so that eta is half of rolling_friction. A facet counts as a sphere
# of twice the grain's radius: with the same eta it has three quarters of a wall's rolling friction.
from math import atan, cos, pi, sin, sqrt

mass = {{ density }} * pi * {{ mean_diameter }}**3 / 6
r_star = {{ mean_diameter }} / 4
hertz = 4 / 3 * {{ youngs_modulus }} / 2 / (1 - {{ poisson_ratio }}**2) * sqrt(r_star)
k_n = hertz * (10 * mass * {{ gravity }} / hertz)**(1 / 3)
k_r = 2.25 * k_n * ({{ rolling_friction }} * r_star)**2

powder = O.materials.append(FrictMat(young={{ youngs_modulus }}, poisson={{ poisson_ratio }},
                                     frictionAngle=atan({{ sliding_friction }}), density={{ density }}))
for line in open('packing.txt'):
    x, y, z, radius = map(float, line.split())
    O.bodies.append(utils.sphere((x, y, z), radius, material=powder))
num_grains = len(O.bodies)

# Tube and plate are polygons of facets; the plate's go from side to side, so that none of their
# corners is under the heap, where a grain would touch many at once.
corners = 48
outer = {{ tube_inner_radius }} / cos(pi / corners)  # its flats touch the circle


def at(radius, corner, z):
    angle = 2 * pi * corner / corners
    return radius * cos(angle), radius * sin(angle), z


top = 1.5 * {{ filled_height }} + {{ largest_diameter }}
tube = []
for k in range(corners):
    low, low_next = at(outer, k, 0), at(outer, k + 1, 0)
    high, high_next = at(outer, k, top), at(outer, k + 1, top)
    tube += O.bodies.append([utils.facet((low, low_next, high_next), material=powder),
                             utils.facet((low, high_next, high), material=powder)])
around = [at({{ plate_radius }}, k // 2 + 1 if k % 2 else -k // 2, 0) for k in range(corners)]
O.bodies.append([utils.facet(around[k:k + 3], material=powder) for k in range(corners - 2)])

O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Facet_Aabb()],
                          verletDist=0.1 * {{ smallest_diameter }} / 2),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Facet_Sphere_ScGeom()],
                    [Ip2_FrictMat_FrictMat_MindlinPhys(en={{ restitution }}, es={{ restitution }},
                                                       krot=k_r, eta={{ rolling_friction }} / 2)],
                    [Law2_ScGeom_MindlinPhys_Mindlin(includeMoment=True)]),
    TranslationEngine(ids=tube, translationAxis=(0, 0, 1), velocity=0, label='lift'),
    NewtonIntegrator(gravity=(0, 0, -{{ gravity }}), damping=0),
]
O.dt = {{ time_step }}


def run(time):
    O.run(max(1, round(time / O.dt)), wait=True)


# Grains that have fallen off are taken out: nothing stops their fall.
def drop_fallen():
    for i in range(num_grains):
        body = O.bodies[i]
        if body is not None and body.state.pos[2] < -2 * {{ plate_radius }}:
            O.bodies.erase(i)


run({{ settling_time }})
lift.velocity = {{ lift_velocity }}
steps = 20
for _ in range(steps):
    run(1.2 * {{ filled_height }} / {{ lift_velocity }} / steps)
    drop_fallen()
for i in tube:
    O.bodies.erase(i)
lift.dead = True
for _ in range(steps):
    run({{ rest_time }} / steps)
    drop_fallen()

with open('heap.csv', 'w') as heap:
    heap.write('x,y,z,radius\n')
    for i in range(num_grains):
        body = O.bodies[i]
        if body is not None:
            heap.write('%.9g,%.9g,%.9g,%.9g\n' % (*body.state.pos, body.shape.radius))
