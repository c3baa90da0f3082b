// A sphere about the origin. Needs root_ahead.glsl.

// How far along `ray` the sphere lies for an eye at `eye` inside it, in lengths of the ray.
SHARED_FN real sphereDistance(real radius, real3 eye, real3 ray) {
    return rootAhead(dot(ray, ray), dot(eye, ray), dot(eye, eye) - radius * radius);
}
