/** Says at the very end which stories failed, in which step and why, in few lines: of a long log people see the end first. */
import { stripVTControlCharacters } from 'node:util';
import type { Reporter, TestCase, TestResult, TestStep } from '@playwright/test/reporter';

const LINES = 12;

export default class Failures implements Reporter {
  private readonly said: string[] = [];

  onTestEnd(test: TestCase, result: TestResult): void {
    if (result.status === test.expectedStatus) return;
    this.said.push(`FAILED ${test.location.file}: ${test.title}`);
    const steps = failedSteps(result.steps);
    if (steps.length > 0) this.said.push(`  in: ${steps.join(' > ')}`);
    for (const { message, location } of result.errors) {
      const lines = stripVTControlCharacters(message ?? '').split('\n');
      const at = location && `  at ${location.file}:${location.line}`;
      this.said.push(...lines.filter((line) => line.trim()).slice(0, LINES), at ?? '');
    }
  }

  onEnd(): void {
    for (const line of this.said) process.stderr.write(`${line}\n`);
  }
}

/** The titles from the outermost to the innermost step that did not end well. */
function failedSteps(steps: readonly TestStep[]): string[] {
  const failed = steps.find((step) => step.error !== undefined);
  return failed === undefined ? [] : [failed.title, ...failedSteps(failed.steps)];
}
