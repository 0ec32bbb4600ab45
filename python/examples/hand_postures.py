"""Principal motion directions of hand postures, and what they are good for.

    python3 hand_postures.py
"""

import numpy as np

import handway


def main():
    rng = np.random.default_rng(1)
    joints = ["thumb_base", "index_proximal", "index_medial", "middle_proximal", "middle_medial"]
    # Postures in which the fingers close together, and the thumb turns on its own.
    closing = rng.uniform(0.2, 0.8, (500, 1))
    together = closing * [0.0, 0.8, 1.0, 0.7, 0.9] + rng.normal(0.0, 0.02, (500, 5))
    thumb = rng.uniform(0.0, 1.0, 500)
    postures = np.clip(together, 0.0, 1.0)
    postures[:, 0] = thumb

    basis = handway.find_pmds(postures, joints, free=["thumb_base"], directions=1, hand="hand")
    print(basis.names, np.round(basis.directions, 2))
    assert basis.directions.shape == (1, 5)
    drawn = basis.posture(rng.uniform(size=(1000, basis.dimension)))
    assert basis.distance(drawn).max() < 0.05, "all of them close the fingers together"


if __name__ == "__main__":
    main()
