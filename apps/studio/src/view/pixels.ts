// A machine that draws in software gets fewer pixels.
const k_slow_picture_s = 1 / 22;
const k_judged_pictures = 24;
const k_least_scale = 0.6;

export class Pixels {
  scale = 1;
  #slow = 0;
  #judged = 0;

  /** After each picture, `seconds` after the last. True where `scale` has fallen. */
  judge(seconds: number): boolean {
    if (this.scale <= k_least_scale || seconds <= 0 || seconds > 1) return false;
    this.#slow += seconds > k_slow_picture_s ? 1 : 0;
    if (++this.#judged < k_judged_pictures) return false;
    const slow = this.#slow > 0.7 * this.#judged;
    this.#slow = this.#judged = 0;
    if (slow) this.scale = Math.max(this.scale - 0.2, k_least_scale);
    return slow;
  }
}
