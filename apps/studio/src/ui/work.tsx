// Long work: what is going on, how far it is, and a way out where there is one.
import { work } from '../bench';

export function WorkCard() {
  const now = work.value;
  if (!now) return null;
  return (
    <div class="work" role="status">
      <p>{now.title}{now.label !== '' && <small>{now.label}{now.total > 1 && ` ${now.done} of ${now.total}`}</small>}</p>
      {now.total > 1 ? <progress max={now.total} value={now.done} aria-label={now.title} /> : <progress aria-label={now.title} />}
      {now.stop && <button type="button" class="small" onClick={now.stop}>Stop</button>}
    </div>
  );
}
