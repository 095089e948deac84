// A number of the graph's file.
import { useState } from 'preact/hooks';
import { edit, fixed, part } from '../graph';

export function EditField(props: { label: string; value: number; pointer: string }) {
  // What is typed is the user's until it is done; then it is what the file says, whether it was taken or not.
  const [draft, setDraft] = useState<string | null>(null);
  const done = async (value: number) => {
    if (Number.isFinite(value)) await edit(props.pointer, value);
    part();
    setDraft(null);
  };
  return (
    <label class="field">
      {props.label}
      <input
        type="number"
        step="any"
        disabled={fixed.value !== ''}
        value={draft ?? props.value}
        onInput={(event) => setDraft(event.currentTarget.value)}
        onChange={(event) => void done(event.currentTarget.valueAsNumber)}
      />
    </label>
  );
}
