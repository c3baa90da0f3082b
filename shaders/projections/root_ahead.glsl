// The one root ahead of a t^2 + 2 b t + c = 0 with c < 0, as for an eye inside a round surface; infinite
// where a is 0. Written without cancellation.
SHARED_FN real rootAhead(real a, real b, real c) {
    real root = sqrt(b * b - a * c);
    return b > 0.0 ? -c / (b + root) : (root - b) / a;
}
