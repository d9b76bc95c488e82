import { expect, type Locator, type Page } from '@playwright/test';
import { Disturb } from './disturb';

/** The page of the campaigns: many random disturbances, and who noticed each. */
export class Campaigns {
  constructor(private readonly page: Page) {}

  get pane(): Locator {
    return this.page.locator('[data-pane="campaign"]');
  }

  /** From the panel of the disturbances. */
  async open(): Promise<void> {
    const disturb = new Disturb(this.page);
    await disturb.show();
    await disturb.pane.getByRole('button', { name: 'Try many at random…' }).click();
    await expect(this.pane).toBeVisible();
  }

  field(name: string): Locator {
    return this.pane.getByRole('textbox', { name, exact: true });
  }

  async begin(): Promise<void> {
    await this.pane.getByRole('button', { name: 'Try', exact: true }).click();
  }

  get over(): Locator {
    return this.pane.getByRole('button', { name: 'Delete this campaign' });
  }

  outcome(name: string): Locator {
    return this.pane.locator(`[data-outcome="${name}"]`);
  }

  get rows(): Locator {
    return this.pane.locator('[data-trial]');
  }
}
