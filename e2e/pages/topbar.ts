import { expect, type Locator, type Page } from '@playwright/test';

/** The strip along the top: which PLC, its mode and state, and its run controls. */
export class TopBar {
  constructor(private readonly page: Page) {}

  get state(): Locator {
    return this.page.getByRole('status', { name: 'PLC state' });
  }

  get picker(): Locator {
    return this.page.getByRole('button', { name: 'Project and instance' });
  }

  get here(): Locator {
    return this.page.getByRole('list', { name: 'Connected users' });
  }

  mode(name: 'PROGRAM' | 'MONITOR' | 'RUN'): Locator {
    return this.page.getByRole('radio', { name, exact: true });
  }

  async chooseMode(name: 'PROGRAM' | 'MONITOR' | 'RUN'): Promise<void> {
    await this.mode(name).click();
    await expect(this.mode(name)).toBeChecked();
  }

  get controls(): Locator {
    return this.page.getByRole('toolbar', { name: 'Run controls' });
  }

  async restart(kind: 'Cold restart' | 'Warm restart' | 'Power cycle' | 'New run…' = 'Cold restart'): Promise<void> {
    await this.controls.getByRole('button', { name: 'Restart' }).click();
    await this.page.getByRole('menuitem', { name: kind }).click();
  }

  async press(control: 'Back one scan' | 'Continue' | 'Pause' | 'Single scan' | 'Forward one scan'): Promise<void> {
    await this.controls.getByRole('button', { name: control, exact: true }).click();
  }

  /** The dialog for a condition at which the run ends. */
  async askUntil(condition: string): Promise<Locator> {
    await this.controls.getByRole('button', { name: 'Run up to' }).click();
    await this.page.getByRole('menuitem', { name: 'Run until…' }).click();
    const dialog = this.page.getByRole('dialog', { name: 'Run until' });
    await dialog.getByRole('textbox', { name: 'Condition' }).fill(condition);
    await dialog.getByRole('button', { name: 'Run', exact: true }).click();
    return dialog;
  }

  async runScans(count: number): Promise<void> {
    await this.controls.getByRole('button', { name: 'Run up to' }).click();
    await this.page.getByRole('menuitem', { name: 'Run scans…' }).click();
    const dialog = this.page.getByRole('dialog', { name: 'Run scans' });
    await dialog.getByRole('textbox', { name: 'Scans' }).fill(String(count));
    await dialog.getByRole('button', { name: 'Run', exact: true }).click();
    await expect(dialog).toBeHidden();
  }

  async showInstances(): Promise<void> {
    await this.picker.click();
    await this.page.getByRole('menuitem', { name: 'Instances…' }).click();
  }

  /** The number of the last scan that this browser knows. */
  async scan(): Promise<number> {
    const text = (await this.page.getByTestId('scan').textContent()) ?? '';
    return Number(text.replace(/\D/g, '') || NaN);
  }

  async scansGoOn(from?: number): Promise<void> {
    const before = from ?? (await this.scan());
    await expect.poll(() => this.scan(), { message: `scans go on from ${before}` }).toBeGreaterThan(before || 0);
  }

  async chooseTheme(name: string): Promise<void> {
    const button = this.page.getByRole('button', { name: /^Theme: / });
    await button.click();
    await this.page.getByRole('menuitemradio', { name, exact: true }).click();
    await expect(button).toHaveAccessibleName(`Theme: ${name}`);
  }

  async newProject(name: string): Promise<void> {
    await this.picker.click();
    await this.page.getByRole('menuitem', { name: 'New project…' }).click();
    const dialog = this.page.getByRole('dialog', { name: 'New project' });
    await dialog.getByRole('textbox', { name: 'Name' }).fill(name);
    await dialog.getByRole('button', { name: 'Create' }).click();
    await expect(dialog).toBeHidden();
    await expect(this.picker).toContainText(name);
  }

  /** Goes to another instance, by what its entry in the menu says. */
  async goTo(entry: RegExp): Promise<void> {
    await this.picker.click();
    await this.page.getByRole('menuitemradio', { name: entry }).click();
  }

  /** Records every change of the state with its time, because a restart may be over before the test looks. */
  async noteStates(): Promise<() => Promise<{ at: number; text: string }[]>> {
    await this.state.evaluate((element) => {
      const noted = [{ at: Date.now(), text: element.textContent ?? '' }];
      new MutationObserver(() => noted.push({ at: Date.now(), text: element.textContent ?? '' })).observe(element, {
        childList: true,
        characterData: true,
        subtree: true,
      });
      Object.assign(window, { notedStates: noted });
    });
    return () => this.page.evaluate(() => (window as unknown as { notedStates: [] }).notedStates);
  }
}
