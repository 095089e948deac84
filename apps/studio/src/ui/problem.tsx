import { problem } from '../session';

export function ProblemCard() {
  const now = problem.value;
  if (!now) return null;
  return (
    <div class={`problem${now.fatal ? ' fatal' : ''}${now.question ? ' question' : ''}`} role="alert">
      <div>
        <h2>{now.title}</h2>
        <p>{now.text}</p>
        <p class="actions">
          {now.actions.map((action) => (
            <button key={action.label} type="button" onClick={action.run}>
              {action.label}
            </button>
          ))}
        </p>
      </div>
    </div>
  );
}
