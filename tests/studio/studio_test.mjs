// The studio in a real browser: what a user sees and does, against what the native build says.
//
//   node tests/studio/studio_test.mjs BUILD/studio PROGRAM NATIVE_TWIN [WORDS OF A TEST'S NAME]
//
// Skipped with a message where there is no browser, unless SUREFOOT_NEED_JUDGES is set.
import { finish } from './harness.mjs';

// One after the other: imports that stand in a row would run at once.
for (const name of ['page', 'project', 'gait', 'crowd', 'graph', 'served', 'race']) await import(`./${name}_tests.mjs`);
await finish();
