import { expect, type Locator, type Page } from '@playwright/test';
import { Editor } from './editor';
import { toFront } from './tabs';

/** The debugger: the gutter of an editor, call stack, variables, breakpoints, console. */
export class Debug {
  constructor(private readonly page: Page) {}

  section(name: 'Call stack' | 'Variables' | 'Breakpoints'): Locator {
    return this.page.getByRole('region', { name, exact: true });
  }

  get frames(): Locator {
    return this.section('Call stack').getByRole('treeitem');
  }

  get breakpoints(): Locator {
    return this.section('Breakpoints').getByRole('treeitem');
  }

  variable(name: string): Locator {
    return this.page.getByTestId(`variable:${name}`);
  }

  /** The next line, marked in full width. */
  haltedLine(file: string): Locator {
    return new Editor(this.page, file).region.locator('.haltline').first();
  }

  /** The marks in the gutter of a file: `gl-bp`, `gl-bp-cond`, `gl-here` ... */
  glyph(file: string, shape: string): Locator {
    return new Editor(this.page, file).region.locator(`.glyph-margin-widgets .${shape}`);
  }

  /** Whether a mark is in the line that contains a text. */
  async isBeside(file: string, shape: string, part: string): Promise<boolean> {
    const mark = await this.glyph(file, shape).first().boundingBox();
    const line = await new Editor(this.page, file).line(part).first().boundingBox();
    return mark !== null && line !== null && Math.abs(mark.y - line.y) < 4;
  }

  /** The gutter beside the line that contains a text. */
  private async gutterAt(file: string, part: string): Promise<{ x: number; y: number }> {
    const editor = new Editor(this.page, file);
    let place = { x: 0, y: 0 };
    // The page scrolls by itself, too: to where a tour or a halt is.
    await expect(async () => {
      await editor.reveal(part);
      const line = await editor.line(part).first().boundingBox();
      const margin = await editor.region.locator('.glyph-margin').first().boundingBox();
      if (!line || !margin) throw new Error(`the line of ${part} is not to be seen`);
      place = { x: margin.x + 9, y: line.y + 10 };
    }).toPass();
    return place;
  }

  async clickGutter(file: string, part: string): Promise<void> {
    const { x, y } = await this.gutterAt(file, part);
    await this.page.mouse.click(x, y);
  }

  /** Chooses an entry of the gutter's menu. */
  async fromGutter(file: string, part: string, item: string): Promise<void> {
    const { x, y } = await this.gutterAt(file, part);
    await this.page.mouse.click(x, y, { button: 'right' });
    await this.page.getByRole('menuitem', { name: item }).click();
  }

  /** The breakpoint form below a line. */
  get form(): Locator {
    return this.page.getByRole('form', { name: /^Breakpoint in line/ });
  }

  async fillForm(entries: Record<string, string>, choices: Record<string, string> = {}): Promise<void> {
    for (const [name, text] of Object.entries(entries)) await this.form.getByRole('textbox', { name }).fill(text);
    for (const [name, choice] of Object.entries(choices))
      await this.form.getByRole('combobox', { name }).selectOption(choice);
    await this.form.getByRole('button', { name: /^(Set|Change)$/ }).click();
  }

  async step(name: 'Step over' | 'Step into' | 'Step out' | 'Step back' | 'Continue' | 'Single scan'): Promise<void> {
    await this.page.getByRole('toolbar', { name: 'Run controls' }).getByRole('button', { name, exact: true }).click();
  }

  /** Types a new value for a variable of the frame, in its row. */
  async setVariable(name: string, value: string): Promise<void> {
    await this.variable(name).click();
    const entry = this.page.getByRole('textbox', { name: `Value of ${name}`, exact: true });
    await entry.fill(value);
    await entry.press('Enter');
  }

  async removeAll(): Promise<void> {
    await this.section('Breakpoints').getByRole('button', { name: 'Remove all breakpoints' }).click();
    await expect(this.breakpoints).toHaveCount(0);
  }

  async showConsole(): Promise<Locator> {
    await toFront(this.page.getByRole('tab', { name: 'Console', exact: true }));
    return this.page.getByRole('log', { name: 'Console' });
  }

  async evaluate(expression: string): Promise<void> {
    const entry = this.page.getByRole('combobox', { name: 'Evaluate an expression' });
    await entry.fill(expression);
    await entry.press('Enter');
  }
}
